// SPDX-License-Identifier: GPL-3.0-or-later
/// \file smoothing.hpp  Removes noise from grey values by filters.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Smooths by edge-preserving diffusion (Perona and Malik): grey value differences below `edge` are smoothed, larger
/// ones remain. `rounds` is the number of steps. ITK's filter is not used, because it takes twenty times as long.
void diffuse(Image<float>& image, double edge, int rounds);

/// Replaces each voxel by the median of 3 × 3 × 3 voxels, computed by ITK.
void median(Image<float>& image);

}  // namespace macadam::ct
