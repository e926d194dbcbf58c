// SPDX-License-Identifier: GPL-3.0-or-later
/// \file paper_recipe.hpp  Segments a scan by the steps of [1], section 3.2.1, in their order, for comparison with
/// our own method. Parameters that [1] does not give have the values of the programs used in [1]: twenty ring zones, a
/// median of 3 × 3 × 3 voxels, one erosion and one dilation by a voxel, and a watershed that joins basins less than
/// half a voxel deep.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Shifts the grey values of every slice to the mean of the scan, then the grey values of every ring zone to the mean
/// of the innermost zone.
void equalise(Image<float>& scan, const Image<std::uint8_t>& region);

/// Segments a scan by the steps of [1]. \throws InputError if no voxel is brighter than the threshold.
Segmentation segment_as_paper(Image<float> scan, const Image<std::uint8_t>& region, const SegmentOptions& options);

}  // namespace macadam::ct
