// SPDX-License-Identifier: GPL-3.0-or-later
/// \file projected_edges.hpp  A surface seen along one direction: how far apart its front and its back are at most.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam {

/// Largest difference of height (z) of two edges where they meet in the xy plane within `rounding`: at crossings, at
/// ends that lie on another edge, and along an edge that is seen end-on [m].
double largest_gap_of_edges(const std::vector<Vec3d>& points, const std::vector<std::array<std::int32_t, 2>>& edges,
                            double rounding);

/// Largest difference of height (z) between a point and a facet that covers it in the xy plane [m].
double largest_gap_over_facets(const std::vector<Vec3d>& points, const std::vector<std::array<std::int32_t, 3>>& facets,
                               double rounding);

}  // namespace macadam
