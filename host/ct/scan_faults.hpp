// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scan_faults.hpp  What a scanner does to the grey values of a specimen.
#pragma once

#include "macadam/phantom.hpp"

namespace macadam::ct {

/// Blur, cupping and rings about the upright axis through the middle, drift of the slices, noise. `radius`: of the
/// specimen [m].
void add_faults(Image<float>& grey, const PhantomSpec& spec, double radius);

}  // namespace macadam::ct
