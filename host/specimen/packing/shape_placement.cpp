// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_placement.cpp  Turns requests into placed bodies, by insertion or packing.
#include "host/specimen/packing/shape_placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "kernels/base/parallel.hpp"
#include "host/specimen/packing/shape_body.hpp"
#include "host/specimen/packing/shape_insertion.hpp"
#include "host/specimen/packing/shape_packing.hpp"
#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Fraction of the box that the bodies fill when packing begins. Insertion still finds places quickly at this fraction.
constexpr double share_at_first = 0.30;
constexpr std::int64_t attempts_at_first = 100'000;

/// Random stream of the placement. The streams of sizes and shapes are numbered in shape_composition.cpp.
constexpr std::uint64_t place_stream = 20'000;

using Geometries = std::vector<std::unique_ptr<const ShapeGeometry>>;

[[noreturn]] void refuse(const std::string& what, const std::string& found, const std::string& expected) {
  throw InputError("aggregates", 0, what, found, expected);
}

void check(const std::vector<ShapeTemplate>& shapes, const ShapeComposition& composition,
           const ShapePlacementSpec& spec) {
  if (spec.attempts < 1) refuse("attempts", std::to_string(spec.attempts), "at least 1");
  if (!(spec.gap > 0 && spec.gap < 0.5)) refuse("gap", shown(spec.gap), "more than 0 and less than 0.5 of D^I");
  if (!(spec.spacing >= 0 && std::isfinite(spec.spacing)))
    refuse("spacing", shown(spec.spacing) + " m", "a finite length, not negative");
  const bool insertion = spec.method == PlacementMethod::insertion;
  if (!insertion && spec.spacing > 0)
    refuse("spacing", shown(spec.spacing) + " m with placement \"packing\"",
           "placement \"insertion\", or a gap instead of the spacing");
  if (!spec.spheres.empty() && (!insertion || spec.spheres.size() != composition.aggregate.size()))
    refuse("spheres", insertion ? std::to_string(spec.spheres.size()) : "spheres with placement \"packing\"",
           "placement \"insertion\", and the spheres of each of " + std::to_string(composition.aggregate.size()) +
               " aggregates");
  for (const AggregateRequest& r : composition.aggregate) {
    if (r.shape < 0 || r.shape >= static_cast<int>(shapes.size()))
      refuse("shape number", std::to_string(r.shape),
             "0 to " + std::to_string(static_cast<std::int64_t>(shapes.size()) - 1));
    if (r.size_class < 0 || r.size_class >= static_cast<int>(composition.row.size()))
      refuse("size class", std::to_string(r.size_class),
             "0 to " + std::to_string(static_cast<std::int64_t>(composition.row.size()) - 1));
    if (!(r.size > 0 && std::isfinite(r.size))) refuse("size", shown(r.size) + " m", "a finite positive length");
  }
}

/// Returns the test data of each shape that at least one request uses.
Geometries prepare(const std::vector<ShapeTemplate>& shapes, const std::vector<AggregateRequest>& requests) {
  std::vector<std::uint8_t> used(shapes.size());
  for (const AggregateRequest& r : requests) used[r.shape] = 1;
  Geometries geometries(shapes.size());
  for_each_in_parallel(shapes.size(), [&](std::size_t k) {
    if (used[k]) geometries[k] = std::make_unique<const ShapeGeometry>(shapes[k]);
  });
  return geometries;
}

/// Returns, for each aggregate, its filling spheres sorted for fast tests; null for an aggregate that is a single
/// sphere.
std::vector<std::unique_ptr<const SphereCluster>> clusters_of(const ShapeComposition& composition,
                                                              const ShapePlacementSpec& spec) {
  double largest = 0;
  for (const MultiSphere& s : spec.spheres)
    if (s.size() > 1) largest = std::max(largest, *std::max_element(s.radius.begin(), s.radius.end()));
  std::vector<std::unique_ptr<const SphereCluster>> clusters(spec.spheres.size());
  for_each_in_parallel(clusters.size(), [&](std::size_t k) {
    if (!composition.aggregate[k].sphere)
      clusters[k] = std::make_unique<const SphereCluster>(spec.spheres[k], largest + spec.spacing);
  });
  return clusters;
}

std::string no_room(const ShapeComposition& composition, const std::vector<ShapeTemplate>& shapes, std::size_t failed,
                    std::int64_t attempts) {
  const AggregateRequest& lost = composition.aggregate[failed];
  double reached = 0, total = 0;
  int placed = 0;
  for (std::size_t k = 0; k < composition.aggregate.size(); ++k) {
    const AggregateRequest& r = composition.aggregate[k];
    if (r.size_class != lost.size_class) continue;
    const double volume = aggregate_volume(shapes[r.shape], r.size, r.sphere);
    total += volume;
    if (k < failed) reached += volume, ++placed;
  }
  char text[400];
  std::snprintf(text, sizeof text,
                "no space for aggregate %d of %d of class %s (intermediate size D^I %.4g mm) in %lld attempts: %d "
                "placed, %.1f %% of the "
                "class's volume; choose less of this class or of coarser classes, a larger box, more attempts, "
                "allow_short = true, or placement = \"packing\"",
                placed + 1, static_cast<int>(composition.row[lost.size_class].count_asked),
                composition.row[lost.size_class].name.c_str(), 1e3 * lost.size, static_cast<long long>(attempts),
                placed, 100 * reached / total);
  return text;
}

/// Inserts the bodies and returns which of them were placed. If a body cannot be placed, the smaller bodies of its
/// class are skipped.
std::vector<std::uint8_t> insert(const Domain& box, const std::vector<ShapeTemplate>& shapes,
                                 const ShapeComposition& composition, const ShapePlacementSpec& spec,
                                 std::vector<ShapeBody>& bodies, const std::function<void(double)>& progress) {
  ShapeInsertion insertion(box, bodies, spec.spacing, spec.attempts, RandomStream(spec.seed, place_stream));
  std::vector<std::uint8_t> placed(bodies.size()), given_up(composition.row.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const int size_class = composition.aggregate[k].size_class;
    if (given_up[size_class]) continue;
    placed[k] = insertion.place(k, bodies[k]);
    if (!placed[k] && !spec.allow_short) throw RunError(spec.origin + no_room(composition, shapes, k, spec.attempts));
    given_up[size_class] = !placed[k];
    if (k % 64 == 0) progress(static_cast<double>(k) / static_cast<double>(bodies.size()));
  }
  progress(1);
  return placed;
}

/// Places the bodies by insertion at a smaller scale, then packs them at full size. \throws RunError if they jam.
void pack_all(const Domain& box, const std::vector<ShapeTemplate>& shapes, const ShapeComposition& composition,
              const ShapePlacementSpec& spec, std::vector<ShapeBody>& bodies, const auto& report) {
  double volume = 0;
  for (const AggregateRequest& r : composition.aggregate) volume += aggregate_volume(shapes[r.shape], r.size, r.sphere);
  const double from = volume > 0 ? std::min(1.0, std::cbrt(share_at_first * box.volume() / volume)) : 1;
  for (ShapeBody& b : bodies) b.scale *= from;
  ShapePlacementSpec first;
  first.seed = spec.seed, first.origin = spec.origin;
  first.attempts = std::min(spec.attempts, attempts_at_first);
  insert(box, shapes, composition, first, bodies, report("placing aggregates"));
  const double reached = pack(box, bodies, from, spec.gap, report("packing aggregates"));
  if (reached == 1) return;
  char text[320];
  std::snprintf(text, sizeof text,
                "the aggregates jammed at %.4g of their final size: they fill %.3g %% of the box, and %.3g %% is "
                "requested; choose less aggregate, a larger box, or a smaller gap",
                reached, 100 * reached * reached * reached * volume / box.volume(), 100 * volume / box.volume());
  throw RunError(spec.origin + text);
}

}  // namespace

ShapeTemplate shape_template(const Surface& surface) {
  const ShapeMeasure m = measure_shape(surface);
  ShapeTemplate t{surface, m.volume, m.d_intermediate};
  for (Vec3d& p : t.surface.points) p -= m.centroid;
  return t;
}

ShapePlacement place_shapes(const Domain& box, const std::vector<ShapeTemplate>& shapes,
                            const ShapeComposition& composition, const ShapePlacementSpec& spec,
                            const std::function<void(const char* stage, double share)>& progress) {
  check(shapes, composition, spec);
  const auto report = [&progress](const char* stage) {
    return [&progress, stage](double share) {
      if (progress) progress(stage, share);
    };
  };
  const Geometries geometries = prepare(shapes, composition.aggregate);
  std::vector<ShapeBody> bodies;
  for (const AggregateRequest& r : composition.aggregate) bodies.emplace_back(*geometries[r.shape], r.size, r.sphere);
  const std::vector<std::unique_ptr<const SphereCluster>> clusters = clusters_of(composition, spec);
  for (std::size_t k = 0; k < clusters.size(); ++k) bodies[k].cluster = clusters[k].get();
  std::vector<std::uint8_t> placed(bodies.size(), 1);
  if (spec.method == PlacementMethod::insertion)
    placed = insert(box, shapes, composition, spec, bodies, report("placing aggregates"));
  else
    pack_all(box, shapes, composition, spec, bodies, report);

  ShapePlacement result{{}, {}, composition.row};
  for (CompositionRow& row : result.row) row.count = 0, row.fraction = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!placed[k]) continue;
    const AggregateRequest& r = composition.aggregate[k];
    result.aggregate.push_back({r.size_class, r.shape, r.sphere, {bodies[k].centre, bodies[k].turn, bodies[k].scale}});
    result.request.push_back(k);
    result.row[r.size_class].count += 1;
    result.row[r.size_class].fraction += aggregate_volume(shapes[r.shape], r.size, r.sphere) / box.volume();
  }
  return result;
}

}  // namespace macadam
