// SPDX-License-Identifier: GPL-3.0-or-later
/// \file convex_hull.hpp  The convex hull of points.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam {

/// Facets of the convex hull, counter-clockwise seen from outside, each from its smallest point number on and all in
/// lexicographic order. A plane is divided from the smallest number of its corners. So the answer depends on the points
/// alone. Points inside the hull, and inside a plane or an edge of it, are in no facet.
std::vector<std::array<std::int32_t, 3>> convex_hull(const std::vector<Vec3d>& points);

}  // namespace macadam
