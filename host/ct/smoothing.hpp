// SPDX-License-Identifier: GPL-3.0-or-later
/// \file smoothing.hpp  Noise out of grey values.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Diffusion that stops at edges (Perona and Malik): steps below `edge` even out, steps above stay. Own code, because
/// ITK's takes twenty times as long.
void diffuse(Image<float>& image, double edge, int rounds);

/// Median of 3 × 3 × 3 voxels, by ITK.
void median(Image<float>& image);

}  // namespace macadam::ct
