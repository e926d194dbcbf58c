// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shaped_aggregates.hpp  The aggregates of a recipe with shapes: drawn, placed, and filled with spheres.
#pragma once

#include <functional>
#include <vector>

#include "host/spheres/relaxation.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Aggregates in their places, largest first. All vectors but `row` and `surfaces` have one entry an aggregate.
struct ShapedAggregates {
  std::vector<Aggregate> aggregate;
  std::vector<MultiSphere> spheres;  ///< in the specimen's box
  std::vector<Surface> surfaces;     ///< GeneratedSpecimen::surfaces
  std::vector<CompositionRow> row;   ///< one a class
  /// Whether a point of the box lies in a shape; single spheres do not count.
  std::function<bool(const Vec3d&)> inside;
  Enclosure outside;  ///< holds spheres out of the shapes, if any

  double volume() const;  ///< of all [m³]
  double smallest_radius() const;
};

/// The aggregates of a recipe with shapes, drawn as they will be, but in no place.
struct ShapeCensus {
  std::int64_t aggregates = 0, spheres = 0, templates = 0;
  double volume = 0;  ///< of all [m³]
};
/// \throws InputError for an impossible recipe or a faulty surface.
ShapeCensus count_shapes(const SpecimenSpec& spec);

/// Follows `spec.shapes`, which must be there. The same spec gives the same bits, for any number of threads.
/// \throws InputError for an impossible recipe or a faulty surface; RunError where aggregates find no room.
ShapedAggregates make_shaped_aggregates(const SpecimenSpec& spec,
                                        const std::function<void(const char* stage, double share)>& progress);

}  // namespace macadam
