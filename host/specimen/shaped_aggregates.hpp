// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shaped_aggregates.hpp  Makes the aggregates of a recipe with shapes: draws them, fills them with spheres, and
/// places them.
#pragma once

#include <functional>
#include <vector>

#include "host/spheres/relaxation.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Placed aggregates, largest first. All vectors except `row` and `surfaces` have one entry per aggregate.
struct ShapedAggregates {
  std::vector<Aggregate> aggregate;
  std::vector<MultiSphere> spheres;  ///< in the frame of the box
  std::vector<Surface> surfaces;     ///< as GeneratedSpecimen::surfaces
  std::vector<CompositionRow> row;   ///< one per class
  /// Returns whether a point of the box lies in a shape. Single spheres do not count.
  std::function<bool(const Vec3d&)> inside;
  Enclosure outside;  ///< wall that holds spheres out of the shapes; empty if the recipe does not request it

  double volume() const;  ///< returns the volume of all aggregates [m³]
  /// Returns the smallest radius of all spheres [m].
  double smallest_radius() const;
};

/// Counts of the aggregates of a recipe with shapes, which are drawn but not placed.
struct ShapeCensus {
  std::int64_t aggregates = 0, spheres = 0, templates = 0;
  double volume = 0;  ///< volume of all aggregates [m³]
};
/// Draws and counts the aggregates. \throws InputError for an impossible recipe or a faulty surface.
ShapeCensus count_shapes(const SpecimenSpec& spec);

/// Draws, fills and places the aggregates of `spec.shapes`, which must be set. The same `spec` gives the same bits for
/// any number of threads. \throws InputError for an impossible recipe or a faulty surface; RunError if aggregates
/// cannot be placed.
ShapedAggregates make_shaped_aggregates(const SpecimenSpec& spec,
                                        const std::function<void(const char* stage, double share)>& progress);

}  // namespace macadam
