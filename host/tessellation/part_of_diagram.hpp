// SPDX-License-Identifier: GPL-3.0-or-later
/// \file part_of_diagram.hpp  Computes the tetrahedra that contain some of the particles, without triangulating all
/// particles.
#pragma once

#include <span>
#include <vector>

#include "host/tessellation/site_tree.hpp"
#include "host/tessellation/triangulation.hpp"

namespace macadam {

/// Returns the tetrahedra of the regular triangulation of all particles that have at least one of the particles `own`
/// as a corner.
///
/// The particles `own` and those near them are triangulated. A tetrahedron of this triangulation also belongs to the
/// triangulation of all particles if, at the tetrahedron's dual point, no other particle has a smaller power than the
/// tetrahedron's corners have.
/// `all`, the trees that together hold all particles, are searched for particles that violate this condition. These
/// particles are inserted. This is repeated until no particle violates it. Neighbours are indices in the result, or −1
/// if the neighbour is infinite or has no corner in `own`.
std::vector<Tetrahedron> tetrahedra_at(const WeightedSites& sites, const std::vector<SiteTree>& all,
                                       const SiteTree& own);

/// Returns all tetrahedra of the triangulation of `particles`.
std::vector<Tetrahedron> all_tetrahedra(const WeightedSites& sites, const std::vector<std::int32_t>& particles);

}  // namespace macadam
