// SPDX-License-Identifier: GPL-3.0-or-later
/// \file projected_edges.hpp  Projects a surface along z and finds the largest distance between its front and its back.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam {

/// Returns the largest difference of height (z) between two edges at a common position in the xy plane (within
/// `rounding`) [m]. Such positions are crossings, ends that lie on another edge, and edges parallel to z, whose two
/// ends coincide.
double largest_gap_of_edges(const std::vector<Vec3d>& points, const std::vector<std::array<std::int32_t, 2>>& edges,
                            double rounding);

/// Returns the largest difference of height (z) between a point and a facet that covers it in the xy plane [m].
double largest_gap_over_facets(const std::vector<Vec3d>& points, const std::vector<std::array<std::int32_t, 3>>& facets,
                               double rounding);

}  // namespace macadam
