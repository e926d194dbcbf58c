// SPDX-License-Identifier: GPL-3.0-or-later
/// \file generate.cpp  Generates a specimen: draws sizes, places aggregates, voids and mastic, relaxes the mastic, and
/// ensures that every sphere has a Laguerre cell.
#include <algorithm>
#include <cmath>
#include <string>

#include "host/specimen/composition.hpp"
#include "host/specimen/generate.hpp"
#include "host/specimen/mastic.hpp"
#include "host/specimen/placement.hpp"
#include "host/specimen/shaped_aggregates.hpp"
#include "host/spheres/relaxation.hpp"
#include "host/spheres/size_law.hpp"
#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"
#include "macadam/specimen.hpp"

namespace macadam {
namespace {

/// Random stream of the placement. The streams of the sizes are numbered in composition.cpp.
constexpr std::uint64_t placement_stream = 2;

double smallest_aggregate(const Composition& composition, const Domain& box) {
  double smallest = std::min({box.size.x, box.size.y, box.size.z});
  for (const Population& p : composition.aggregate)
    if (!p.radius.empty()) smallest = std::min(smallest, p.radius.back());
  return smallest;
}

/// Appends the description of each aggregate that is a single sphere.
void describe(Specimen& specimen, const std::vector<std::int32_t>& size_class, std::vector<Aggregate>& out) {
  for (std::size_t k = 0; k < size_class.size(); ++k) {
    Aggregate a;
    a.body = specimen.body[k];
    a.size_class = size_class[k];
    a.shape = "sphere";
    a.size = a.d_long = a.d_short = 2 * specimen.radius[k];
    a.volume = sphere_volume(a.size);
    a.centre = specimen.centre[k];
    out.push_back(a);
  }
}

/// Returns the radius of the largest void [m], or 0 without voids.
double largest(const std::vector<Population>& voids) {
  return voids.empty() || voids.front().radius.empty() ? 0 : voids.front().radius.front();
}

/// Adds the voids to the spheres, after the aggregates. Until the mastic is relaxed, voids are treated as fixed
/// aggregates. Returns the index of the first void.
std::size_t place_voids(const std::vector<Population>& voids, GeneratedSpecimen& result, Placement& placement) {
  const std::size_t first = result.specimen.size();
  for (const Population& p : voids) placement.place_voids(p, static_cast<std::int32_t>(result.aggregates.size()));
  return first;
}

/// A specimen whose mastic is not relaxed yet, and the index range of its voids.
struct Placed {
  Placement placement;
  std::size_t first_void, end_of_voids;  ///< indices in the list of spheres
};

/// Places aggregates that are single spheres, voids and mastic.
Placed with_spheres(const SpecimenSpec& spec, GeneratedSpecimen& result,
                    const std::function<void(double share)>& progress) {
  const Composition composition = compose(spec);
  const std::vector<Population> voids = compose_voids(spec);
  for (const auto* populations : {&composition.aggregate, &composition.mastic, &voids})
    for (const Population& p : *populations) result.composition.push_back(p.row);
  Placement placement(result.specimen, smallest_aggregate(composition, spec.box), spec.attempts,
                      RandomStream(spec.seed, placement_stream), Origin(spec), {}, largest(voids));
  describe(result.specimen, placement.place_aggregates(composition.aggregate, spec.spacing, progress),
           result.aggregates);
  const std::size_t first_void = place_voids(voids, result, placement), end_of_voids = result.specimen.size();
  for (const Population& p : composition.mastic) placement.place_mastic(p);
  return {std::move(placement), first_void, end_of_voids};
}

/// Places aggregates with real shapes, voids and mastic. Sets `wall` to the wall that holds the mastic out of the
/// shapes, if the recipe requests one.
Placed with_shapes(const SpecimenSpec& spec, GeneratedSpecimen& result, Enclosure& wall,
                   const std::function<void(const char* stage, double share)>& progress) {
  const std::vector<Population> voids = compose_voids(spec);
  ShapedAggregates shaped = make_shaped_aggregates(spec, progress);
  result.composition = shaped.row;
  Placement placement(result.specimen, shaped.smallest_radius(), spec.attempts,
                      RandomStream(spec.seed, placement_stream), Origin(spec), shaped.inside, largest(voids));
  for (std::size_t k = 0; k < shaped.spheres.size(); ++k) {
    for (std::size_t i = 0; i < shaped.spheres[k].size(); ++i)
      placement.add_aggregate(shaped.spheres[k].centre[i], shaped.spheres[k].radius[i], shaped.aggregate[k].body);
  }
  const double volume = shaped.volume();
  result.aggregates = std::move(shaped.aggregate);
  result.surfaces = std::move(shaped.surfaces);
  const std::size_t first_void = place_voids(voids, result, placement), end_of_voids = result.specimen.size();
  for (const Population& p : compose_mastic(spec, volume)) {
    result.composition.push_back(p.row);
    placement.place_mastic(p);
  }
  for (const Population& p : voids) result.composition.push_back(p.row);
  wall = std::move(shaped.outside);
  return {std::move(placement), first_void, end_of_voids};
}

}  // namespace

GeneratedWithCells generate_with_cells(const SpecimenSpec& spec,
                                       const std::function<void(const char* stage, double share)>& progress) {
  if (spec.file)
    throw InputError(spec.source, spec.line, "recipe", "the file " + spec.file->string(),
                     "no file, because a generated specimen is not read from a file");
  if (!(spec.spacing >= 0 && std::isfinite(spec.spacing)))
    throw InputError(spec.source, spec.line, "spacing", shown(spec.spacing) + " m", "a finite length, not negative");
  const auto placing = [&](double share) {
    if (progress) progress("placing aggregates", share);
  };

  GeneratedWithCells cells;
  GeneratedSpecimen& result = cells.made;
  Specimen& specimen = result.specimen;
  specimen.box = spec.box;
  specimen.source = spec.line > 0 ? "specimen generated from " + spec.source : "generated specimen";
  if ((spec.shapes || spec.voids) && !spec.fix_aggregates)
    throw InputError(spec.source, spec.line, "fix_aggregates", "false",
                     spec.shapes ? "true, because otherwise the spheres of one shape would move apart"
                                 : "true, because otherwise the voids would move with the aggregates");
  Enclosure wall;
  auto [placement, first_void, end_of_voids] =
      spec.shapes ? with_shapes(spec, result, wall, progress) : with_spheres(spec, result, placing);

  SettledMastic settled = settle_mastic(specimen, placement, spec.fix_aggregates, Origin(spec), wall, progress);
  result.relaxation_iterations = settled.iterations;
  // If there are voids, this tessellation counts them as particles. The particles of the finished specimen have other
  // numbers, so the tessellation cannot be reused.
  if (first_void == end_of_voids) {
    cells.tessellation = std::move(settled.tessellation);
    cells.seconds_tessellation = settled.seconds_tessellation;
  }
  if (!spec.fix_aggregates) {
    for (Aggregate& a : result.aggregates) a.centre = specimen.centre[static_cast<std::size_t>(a.body)];
    result.residual_overlap = largest_aggregate_overlap(specimen);
  }
  part_voids(first_void, end_of_voids, specimen);
  validate(specimen, specimen.source);
  return cells;
}

GeneratedSpecimen generate_specimen(const SpecimenSpec& spec,
                                    const std::function<void(const char* stage, double share)>& progress) {
  return generate_with_cells(spec, progress).made;
}

}  // namespace macadam
