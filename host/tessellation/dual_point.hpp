// SPDX-License-Identifier: GPL-3.0-or-later
/// \file dual_point.hpp  Computes the vertex of the power diagram that has the same power with respect to four sites.
/// The power of a point is its squared distance from the site minus the weight of the site.
#pragma once

#include "host/tessellation/weighted_sites.hpp"

namespace macadam {

/// Returns the point of equal power with respect to four sites [m]. The sites must be given in the order of
/// comes_before(), because the bits of the result depend on their order.
Vec3d dual_point(const WeightedSites& sites, const SiteNumbers& number);

}  // namespace macadam
