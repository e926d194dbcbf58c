// SPDX-License-Identifier: GPL-3.0-or-later
/// \file mastic.hpp  Mastic that spreads around what holds still: aggregates and voids.
#pragma once

#include <functional>

#include "host/specimen/placement.hpp"
#include "host/spheres/relaxation.hpp"

namespace macadam {

/// Relaxes a specimen until the spheres are evenly spread and each has a Laguerre cell; mastic without one gets another
/// place. `wall` is relax()'s. Voids are still among the aggregates. Returns the iterations. \throws RunError naming
/// spheres without a cell.
int settle_mastic(Specimen& specimen, Placement& placement, bool fix_aggregates, const Origin& origin,
                  const Enclosure& wall, const std::function<void(double share)>& progress);

/// Takes the voids, spheres from number `first` to below `end`, from among the particles.
void part_voids(std::size_t first, std::size_t end, Specimen& specimen);

}  // namespace macadam
