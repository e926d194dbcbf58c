// SPDX-License-Identifier: GPL-3.0-or-later
/// \file distance.hpp  Computes the distances of voxels from the surface of a mask.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Returns for each voxel of the mask (not 0) its distance from the mask's surface [m], and −1 for other voxels.
/// Computed by ITK (Maurer). The end of the image does not count as surface.
Image<float> distance_inside(Image<std::uint8_t>& mask);

}  // namespace macadam::ct
