// SPDX-License-Identifier: GPL-3.0-or-later
// census.cpp  Counts the aggregates, mastic spheres and voids of a specimen.
#include "host/specimen/census.hpp"

#include <algorithm>

#include "host/specimen/composition.hpp"
#include "host/specimen/shaped_aggregates.hpp"
#include "macadam/tessellation.hpp"
#include "host/spheres/sparse_box.hpp"

namespace macadam {
namespace {

/// Checks the packing of a specimen that was read from a file. For more than 500,000 cells only the filled fraction is
/// checked, because the tessellation takes 10 s per million cells on one thread.
std::vector<std::string> warnings_of(const Specimen& specimen) {
  constexpr std::size_t most_cells = 500'000;
  if (specimen.cells() <= most_cells) return packing_warnings(specimen, tessellate(specimen));
  std::string sparse = sparse_box(specimen);
  return sparse.empty() ? std::vector<std::string>() : std::vector{std::move(sparse)};
}

/// Reads a specimen file and counts its aggregates, spheres and voids.
Census of_file(const SpecimenSpec& spec) {
  const Specimen specimen = read_specimen_csv(*spec.file, spec.box);
  Census out;
  std::int32_t last = -1;
  for (const std::int32_t body : specimen.body) last = std::max(last, body);
  out.aggregates = last + 1;
  out.mastic = std::count(specimen.phase.begin(), specimen.phase.end(), Phase::mastic);
  out.in_aggregates = static_cast<std::int64_t>(specimen.size()) - out.mastic;
  out.voids = static_cast<std::int64_t>(specimen.voids.size());
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    double& smallest = specimen.phase[i] == Phase::mastic ? out.smallest_mastic : out.smallest_in_aggregates;
    if (smallest == 0 || specimen.radius[i] < smallest) smallest = specimen.radius[i];
  }
  out.warnings = warnings_of(specimen);
  return out;
}

}  // namespace

Census count_specimen(const SpecimenSpec& spec) {
  if (spec.file) return of_file(spec);
  Census out;
  const double box = spec.box.volume();
  if (spec.shapes) {
    const ShapeCensus shapes = count_shapes(spec);
    out.aggregates = shapes.aggregates, out.in_aggregates = shapes.spheres, out.templates = shapes.templates;
    if (spec.mastic) out.mastic = mastic_number(spec, shapes.volume);
  } else {
    const Recipe recipe = solve_recipe(spec);
    for (const ClassRequest& request : recipe.aggregate) out.aggregates += request.number(box);
    out.in_aggregates = out.aggregates;
    if (recipe.mastic) out.mastic = recipe.mastic->number(box);
  }
  out.voids = void_number(spec);
  return out;
}

}  // namespace macadam
