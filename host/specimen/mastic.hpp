// SPDX-License-Identifier: GPL-3.0-or-later
/// \file mastic.hpp  Spreads the mastic around fixed aggregates and voids.
#pragma once

#include <functional>

#include "host/specimen/placement.hpp"
#include "host/spheres/relaxation.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

/// Result of settle_mastic().
struct SettledMastic {
  int iterations = 0;
  Tessellation tessellation;        ///< tessellation of the relaxed spheres, each of which has a cell
  double seconds_tessellation = 0;  ///< time of this tessellation [s]
};

/// Relaxes a specimen until the spheres are evenly spread and each has a Laguerre cell. Mastic spheres without a cell
/// are moved to new places. `wall` is passed to relax(); `progress` may be empty. When this function is called, voids
/// are still spheres of the specimen and are treated as aggregates. \throws RunError naming the spheres without a cell
/// if there are any after 10 rounds.
SettledMastic settle_mastic(Specimen& specimen, Placement& placement, bool fix_aggregates, const Origin& origin,
                            const Enclosure& wall,
                            const std::function<void(const char* stage, double share)>& progress);

/// Moves the voids, which are the spheres from index `first` to `end` − 1, from the particles to Specimen::voids.
void part_voids(std::size_t first, std::size_t end, Specimen& specimen);

}  // namespace macadam
