// SPDX-License-Identifier: GPL-3.0-or-later
/// \file paper_recipe.hpp  The steps of [1], section 3.2.1, in their order, for comparison. What [1] leaves open is
/// taken as its programs have it: twenty ring zones, a median of 3 × 3 × 3 voxels, one round of erosion and dilation by
/// a voxel, a watershed that joins basins less than half a voxel deep.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Shifts every slice to the mean grey value of the scan, then every ring zone to that of the innermost one.
void equalise(Image<float>& scan, const Image<std::uint8_t>& region);

Segmentation segment_as_paper(Image<float> scan, const Image<std::uint8_t>& region, const SegmentOptions& options);

}  // namespace macadam::ct
