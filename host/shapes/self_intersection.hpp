// SPDX-License-Identifier: GPL-3.0-or-later
/// \file self_intersection.hpp  Facets of one surface that cut each other.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// Numbers, in ascending order, of the facets that meet another one elsewhere than in a common point or edge. Exact
/// predicates: no tolerance. `skip` marks facets to leave out (those without area, which have no plane). Points of
/// equal coordinates count as one.
std::vector<std::int32_t> self_intersecting_facets(const Surface& surface, const std::vector<bool>& skip);

}  // namespace macadam
