// SPDX-License-Identifier: GPL-3.0-or-later
/// \file part_of_diagram.hpp  The tetrahedra at some of the particles, without a triangulation of all.
#pragma once

#include <span>
#include <vector>

#include "host/tessellation/site_tree.hpp"
#include "host/tessellation/triangulation.hpp"

namespace macadam {

/// The tetrahedra of the regular triangulation of all particles that have one of `own` as a corner.
///
/// `own` and what is near is triangulated. A tetrahedron is one of the whole triangulation if no other particle has a
/// smaller power at its dual point than its corners have: particles that do are looked for in the trees of all, and
/// inserted, until there is none. Neighbours are numbers in the result; −1: without a corner of `own`, or infinite.
std::vector<Tetrahedron> tetrahedra_at(const WeightedSites& sites, const std::vector<SiteTree>& all,
                                       const SiteTree& own);

/// Those of the whole triangulation, by one that is not divided.
std::vector<Tetrahedron> all_tetrahedra(const WeightedSites& sites, const std::vector<std::int32_t>& particles);

}  // namespace macadam
