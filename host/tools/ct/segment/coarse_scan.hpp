// SPDX-License-Identifier: GPL-3.0-or-later
/// \file coarse_scan.hpp  Reads a scan that does not fit in memory as means of blocks of voxels.
#pragma once

#include "host/tools/ct/images/image_slices.hpp"

namespace macadam::ct {

/// An image file, the edges of its voxels, and the size of the blocks.
struct FineScan {
  ImageSlices& file;
  Vec3d spacing{};            ///< [m]
  std::int64_t block = 1;     ///< edge of a block [voxels]
  std::int64_t slab() const;  ///< slices per read, a multiple of `block`
  /// Converts a voxel index to a block index. Whole block indices lie at the middles of the blocks.
  double in_blocks(double voxel) const { return (voxel + 0.5) / static_cast<double>(block) - 0.5; }
};

/// The scan on the grid of the blocks: the mean of each block, and the voxel in the middle of each block, which still
/// has the noise of the scan. Voxels at the far ends that do not fill a block are left out.
struct CoarseScan {
  Image<float> means, middles;
};
/// Reads the whole file once, slab by slab. \throws InputError.
CoarseScan read_coarse(const FineScan& scan, const SegmentOptions& options);

}  // namespace macadam::ct
