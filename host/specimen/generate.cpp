// SPDX-License-Identifier: GPL-3.0-or-later
/// \file generate.cpp  The generator: compose, place, relax, and make sure that every sphere has a Laguerre cell.
#include <algorithm>
#include <cmath>
#include <string>

#include "host/specimen/composition.hpp"
#include "host/specimen/placement.hpp"
#include "host/specimen/shaped_aggregates.hpp"
#include "host/spheres/relaxation.hpp"
#include "host/spheres/size_law.hpp"
#include "host/spheres/specimen_check.hpp"
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

/// Aggregates that are single spheres, and the mastic.
Placement with_spheres(const SpecimenSpec& spec, GeneratedSpecimen& result,
                       const std::function<void(double share)>& progress) {
  const Composition composition = compose(spec);
  for (const auto* populations : {&composition.aggregate, &composition.mastic})
    for (const Population& p : *populations) result.composition.push_back(p.row);
  Placement placement(result.specimen, smallest_aggregate(composition, spec.box), spec.attempts,
                      RandomStream(spec.seed, placement_stream), Origin(spec));
  describe(result.specimen, placement.place_aggregates(composition.aggregate, spec.spacing, progress),
           result.aggregates);
  for (const Population& p : composition.mastic) placement.place_mastic(p);
  return placement;
}

/// Aggregates of real shape, and the mastic; `wall` will hold it out of the shapes where that is asked for.
Placement with_shapes(const SpecimenSpec& spec, GeneratedSpecimen& result, Wall& wall,
                      const std::function<void(const char* stage, double share)>& progress) {
  if (!spec.fix_aggregates)
    throw InputError(spec.source, spec.line, "fix_aggregates", "false", "true, as the spheres of a shape would part");
  ShapedAggregates shaped = make_shaped_aggregates(spec, progress);
  result.composition = shaped.row;
  Placement placement(result.specimen, shaped.smallest_radius(), spec.attempts,
                      RandomStream(spec.seed, placement_stream), Origin(spec), shaped.inside);
  for (std::size_t k = 0; k < shaped.spheres.size(); ++k) {
    for (std::size_t i = 0; i < shaped.spheres[k].size(); ++i)
      placement.add_aggregate(shaped.spheres[k].centre[i], shaped.spheres[k].radius[i], shaped.aggregate[k].body);
  }
  for (const Population& p : compose_mastic(spec, shaped.volume())) {
    result.composition.push_back(p.row);
    placement.place_mastic(p);
  }
  result.aggregates = std::move(shaped.aggregate);
  wall = std::move(shaped.outside);
  return placement;
}

/// Gives hidden mastic a new random place.
void reinsert(const std::vector<std::int32_t>& hidden, Specimen& specimen, Placement& placement) {
  for (std::int32_t i : hidden)
    if (specimen.phase[i] == Phase::mastic) specimen.centre[i] = placement.point_outside_aggregates();
}

[[noreturn]] void give_up(const Origin& origin, const std::vector<std::int32_t>& hidden) {
  std::string message = std::to_string(hidden.size()) + " particles have no Laguerre cell after " +
                        std::to_string(most_rounds) + " rounds of relaxation:";
  constexpr std::size_t shown = 10;
  for (std::size_t k = 0; k < std::min(hidden.size(), shown); ++k) message += " " + std::to_string(hidden[k]);
  if (hidden.size() > shown) message += " …";
  throw RunError(origin.text() + message + "; ask for fewer or more equal mastic spheres");
}

}  // namespace

GeneratedSpecimen generate_specimen(const SpecimenSpec& spec,
                                    const std::function<void(const char* stage, double share)>& progress) {
  if (spec.file)
    throw InputError(spec.source, spec.line, "recipe", "the file " + spec.file->string(), "no file to generate");
  if (!(spec.spacing >= 0 && std::isfinite(spec.spacing)))
    throw InputError(spec.source, spec.line, "spacing", shown(spec.spacing) + " m", "a finite length, not negative");
  const auto report = [&](const char* stage) {
    return [&progress, stage](double share) {
      if (progress) progress(stage, share);
    };
  };

  GeneratedSpecimen result;
  Specimen& specimen = result.specimen;
  specimen.box = spec.box;
  specimen.source = spec.line > 0 ? "specimen generated from " + spec.source : "generated specimen";
  Wall wall;
  Placement placement = spec.shapes ? with_shapes(spec, result, wall, progress)
                                    : with_spheres(spec, result, report("placing aggregates"));

  std::vector<std::int32_t> hidden;
  for (int round = 0; round < most_rounds; ++round) {
    reinsert(hidden, specimen, placement);
    result.relaxation_iterations += relax(specimen, spec.fix_aggregates, report("relaxing mastic"), wall);
    hidden = particles_without_cell(specimen);
    if (hidden.empty()) break;
  }
  if (!hidden.empty()) give_up(Origin(spec), hidden);
  if (!spec.fix_aggregates) {
    for (Aggregate& a : result.aggregates) a.centre = specimen.centre[static_cast<std::size_t>(a.body)];
    result.residual_overlap = largest_aggregate_overlap(specimen);
  }
  validate(specimen, specimen.source);
  return result;
}

}  // namespace macadam
