// SPDX-License-Identifier: GPL-3.0-or-later
/// \file equal_points.hpp  Joins points of a surface that have equal coordinates. STL files, for example, repeat a
/// point for every facet.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// Returns, for every point, the lowest number among the points that have exactly the same coordinates. All coordinates
/// must be finite.
std::vector<std::int32_t> first_of_equal(const std::vector<Vec3d>& points);

/// Replaces point p by point `to[p]` in every facet, then removes the points that no facet uses. The remaining points
/// keep their order; facets keep their numbers.
void replace_points(Surface& surface, const std::vector<std::int32_t>& to);

/// Joins points of equal coordinates and removes points that no facet uses. The remaining points keep their order;
/// facets keep their numbers.
void join_equal_points(Surface& surface);

}  // namespace macadam
