// SPDX-License-Identifier: GPL-3.0-or-later
/// \file generate.cpp  The generator: compose, place, relax, and make sure that every sphere has a Laguerre cell.
#include <algorithm>
#include <string>

#include "host/specimen/composition.hpp"
#include "host/specimen/placement.hpp"
#include "host/specimen/relaxation.hpp"
#include "macadam/error.hpp"
#include "macadam/specimen.hpp"

namespace macadam {
namespace {

constexpr int most_rounds = 10;  // of relaxation, to free the last hidden spheres

/// Random streams of the placement; those of the sizes are numbered in composition.cpp.
constexpr std::uint64_t placement_stream = 2;

double smallest_aggregate(const Composition& composition, const Box& box) {
  double smallest = std::min({box.size.x, box.size.y, box.size.z});
  for (const Population& p : composition.aggregate)
    if (!p.radius.empty()) smallest = std::min(smallest, p.radius.back());
  return smallest;
}

/// Gives hidden mastic a new random place.
void reinsert(const std::vector<std::int32_t>& hidden, Specimen& specimen, Placement& placement) {
  for (std::int32_t i : hidden)
    if (specimen.phase[i] == Phase::mastic) specimen.centre[i] = placement.point_outside_aggregates();
}

[[noreturn]] void give_up(const std::vector<std::int32_t>& hidden) {
  std::string message = std::to_string(hidden.size()) + " particles have no Laguerre cell after " +
                        std::to_string(most_rounds) + " rounds of relaxation:";
  constexpr std::size_t shown = 10;
  for (std::size_t k = 0; k < std::min(hidden.size(), shown); ++k) message += " " + std::to_string(hidden[k]);
  if (hidden.size() > shown) message += " …";
  throw RunError(message + "; ask for fewer or more equal mastic spheres");
}

}  // namespace

GeneratedSpecimen generate_specimen(const SpecimenSpec& spec,
                                    const std::function<void(const char* stage, double share)>& progress) {
  if (spec.file) throw InputError("specimen", 0, "recipe", "the file " + spec.file->string(), "no file to generate");
  const auto report = [&](const char* stage) {
    return [&progress, stage](double share) {
      if (progress) progress(stage, share);
    };
  };

  const Composition composition = compose(spec);
  GeneratedSpecimen result;
  Specimen& specimen = result.specimen;
  specimen.box = spec.box;
  for (const auto* populations : {&composition.aggregate, &composition.mastic})
    for (const Population& p : *populations) result.composition.push_back(p.row);

  Placement placement(specimen, smallest_aggregate(composition, spec.box), spec.attempts,
                      RandomStream(spec.seed, placement_stream));
  placement.place_aggregates(composition.aggregate, report("placing aggregates"));
  for (const Population& p : composition.mastic) placement.place_mastic(p);

  std::vector<std::int32_t> hidden;
  for (int round = 0; round < most_rounds; ++round) {
    reinsert(hidden, specimen, placement);
    result.relaxation_iterations += relax(specimen, spec.fix_aggregates, report("relaxing mastic"));
    hidden = particles_without_cell(specimen);
    if (hidden.empty()) break;
  }
  if (!hidden.empty()) give_up(hidden);
  if (!spec.fix_aggregates) result.residual_overlap = largest_aggregate_overlap(specimen);
  validate(specimen, "generated specimen");
  return result;
}

}  // namespace macadam
