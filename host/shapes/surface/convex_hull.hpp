// SPDX-License-Identifier: GPL-3.0-or-later
/// \file convex_hull.hpp  Computes the convex hull of points.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam {

/// Returns the facets of the convex hull, counter-clockwise seen from outside. Each facet begins with its smallest
/// point number, and the facets are in lexicographic order. A polygonal face is divided into triangles from the
/// smallest of its point numbers. The result therefore depends on the points only. Points inside the hull, or in the
/// interior of one of its faces or edges, belong to no facet.
std::vector<std::array<std::int32_t, 3>> convex_hull(const std::vector<Vec3d>& points);

}  // namespace macadam
