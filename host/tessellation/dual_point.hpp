// SPDX-License-Identifier: GPL-3.0-or-later
/// \file dual_point.hpp  The point that has the same power to four sites.
#pragma once

#include "host/tessellation/weighted_sites.hpp"

namespace macadam {

/// The point of equal power to four sites in the order of comes_before(), on whose bits it depends. [m]
Vec3d dual_point(const WeightedSites& sites, const SiteNumbers& number);

}  // namespace macadam
