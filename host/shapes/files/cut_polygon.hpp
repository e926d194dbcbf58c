// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cut_polygon.hpp  Divides polygonal facets with more than three corners into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// Properties of a polygon that was divided.
struct PolygonCut {
  /// Largest distance of a corner from the polygon's mean plane, divided by the largest distance of a corner from the
  /// polygon's middle.
  double bend = 0;
  /// Whether the outline crosses or touches itself or encloses no area. The triangles may then overlap.
  bool crossed = false;
};

/// Appends the triangles of a polygon to `facets`. No points are added, and the triangles keep the polygon's outline,
/// so that a closed surface remains closed. A polygon that is not convex is divided within its outline. A corner with
/// the same coordinates as the corner before it is skipped.
PolygonCut cut_polygon(const std::vector<Vec3d>& points, std::span<const std::int64_t> corners,
                       std::vector<std::array<std::int32_t, 3>>& facets);

}  // namespace macadam
