// SPDX-License-Identifier: GPL-3.0-or-later
/// \file self_intersection.hpp  Finds facets of one surface that intersect each other.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// Returns, in ascending order, the numbers of the facets that meet another facet elsewhere than in a common point or
/// edge. Uses exact predicates without tolerances. Facets marked in `skip` are left out; they must include all facets
/// without area, which have no plane. Points with equal coordinates count as one.
std::vector<std::int32_t> self_intersecting_facets(const Surface& surface, const std::vector<bool>& skip);

}  // namespace macadam
