// SPDX-License-Identifier: GPL-3.0-or-later
/// \file columns.hpp  Volumes of a shape, of a union of spheres, and of what they share.
#pragma once

#include "macadam/shape.hpp"

namespace macadam {

/// All in m³.
struct SharedVolume {
  double shape = 0, spheres = 0, common = 0;
};

/// Integrates over a regular grid of parallel columns, about 400 of them along the longer side: exactly along each
/// column, by the midpoint rule across them.
SharedVolume shared_volume(const Surface& surface, const MultiSphere& cluster);

}  // namespace macadam
