// SPDX-License-Identifier: GPL-3.0-or-later
/// \file convex_hull.hpp  The convex hull of points that are all its corners.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam {

/// Facets of the convex hull, counter-clockwise seen from outside, each from its smallest point number on and all in
/// lexicographic order, so that the answer depends on the points alone. Points inside the hull are in no facet.
std::vector<std::array<std::int32_t, 3>> convex_hull(const std::vector<Vec3d>& points);

}  // namespace macadam
