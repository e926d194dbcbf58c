// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cut_polygon.hpp  Facets of more than three corners are cut into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// Properties of a polygon that was cut.
struct PolygonCut {
  /// Largest distance of a corner from the polygon's mean plane, over the largest distance from its middle.
  double bend = 0;
  /// Its outline crosses or touches itself, or encloses no area: its triangles may overlap.
  bool crossed = false;
};

/// Appends the triangles of a polygon of more than three corners to `facets`, without new points and with the polygon's
/// outline as theirs, so that a surface that is closed stays closed. A polygon that is not convex is cut within its
/// outline. Corners at the same place as the corner before are left out.
PolygonCut cut_polygon(const std::vector<Vec3d>& points, std::span<const std::int64_t> corners,
                       std::vector<std::array<std::int32_t, 3>>& facets);

}  // namespace macadam
