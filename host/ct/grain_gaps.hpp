// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grain_gaps.hpp  Which grains are near each other.
#pragma once

#include "macadam/phantom.hpp"

namespace macadam::ct {

/// Pairs with gaps up to `widest` [m], by a and b. Of two polyhedra the gap is between the points of one and the
/// surface of the other: where two edges are nearest, somewhat more than it is.
std::vector<GrainGap> grain_gaps(const std::vector<PhantomGrain>& grains, double widest);

}  // namespace macadam::ct
