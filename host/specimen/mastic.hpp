// SPDX-License-Identifier: GPL-3.0-or-later
/// \file mastic.hpp  Mastic that spreads around what holds still: aggregates and voids.
#pragma once

#include <functional>

#include "host/specimen/placement.hpp"
#include "host/spheres/relaxation.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

struct SettledMastic {
  int iterations = 0;
  Tessellation tessellation;        ///< of the settled spheres, none of which is hidden
  double seconds_tessellation = 0;  ///< what that took
};

/// Relaxes a specimen until the spheres are evenly spread and each has a Laguerre cell; mastic without one gets another
/// place. `wall` is relax()'s, `progress` may be empty. Voids are still among the aggregates. \throws RunError naming
/// spheres without a cell.
SettledMastic settle_mastic(Specimen& specimen, Placement& placement, bool fix_aggregates, const Origin& origin,
                            const Enclosure& wall,
                            const std::function<void(const char* stage, double share)>& progress);

/// Takes the voids, spheres from number `first` to below `end`, from among the particles.
void part_voids(std::size_t first, std::size_t end, Specimen& specimen);

}  // namespace macadam
