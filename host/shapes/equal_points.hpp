// SPDX-License-Identifier: GPL-3.0-or-later
/// \file equal_points.hpp  Which points of a surface are the same one: STL, for instance, repeats them a facet.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// For every point the lowest number among the points with its very coordinates (finite ones).
std::vector<std::int32_t> first_of_equal(const std::vector<Vec3d>& points);

/// Makes every facet name point `to[p]` in place of point p, and drops the points that no facet names then. The order
/// of the others stays, facets keep their numbers.
void replace_points(Surface& surface, const std::vector<std::int32_t>& to);

/// Joins equal points and drops those that no facet names; the order of the others stays, facets keep their numbers.
void join_equal_points(Surface& surface);

}  // namespace macadam
