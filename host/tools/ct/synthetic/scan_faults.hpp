// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scan_faults.hpp  Adds the faults of a scanner to the grey values of a phantom.
#pragma once

#include "macadam/phantom.hpp"

namespace macadam::ct {

/// Adds blur, cupping and rings about the vertical axis through the middle, drift of the slices, and noise. `radius` is
/// the radius of the specimen [m].
void add_faults(Image<float>& grey, const PhantomSpec& spec, double radius);

}  // namespace macadam::ct
