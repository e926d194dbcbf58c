// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grain_gaps.hpp  Finds grains that are near each other.
#pragma once

#include "macadam/phantom.hpp"

namespace macadam::ct {

/// Returns the pairs of grains with gaps up to `widest` [m], sorted by a and b. The gap of two polyhedra is the
/// smallest distance of a point of one from the surface of the other. Where two edges are nearest, this is somewhat
/// more than the true gap.
std::vector<GrainGap> grain_gaps(const std::vector<PhantomGrain>& grains, double widest);

}  // namespace macadam::ct
