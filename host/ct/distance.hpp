// SPDX-License-Identifier: GPL-3.0-or-later
/// \file distance.hpp  Distances within a mask.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Distance of the voxels of a mask (not 0) from its surface [m]; elsewhere −1. By ITK (Maurer). The end of
/// the image is no surface.
Image<float> distance_inside(Image<std::uint8_t>& mask);

}  // namespace macadam::ct
