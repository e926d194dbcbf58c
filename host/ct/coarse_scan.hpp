// SPDX-License-Identifier: GPL-3.0-or-later
/// \file coarse_scan.hpp  A scan on a coarser grid, read slices at a time.
#pragma once

#include "host/ct/image_slices.hpp"

namespace macadam::ct {

/// A file whose voxels have edges.
struct FineScan {
  ImageSlices& file;
  Vec3d spacing{};            ///< [m]
  std::int64_t block = 1;     ///< edge of a block [voxels]
  std::int64_t slab() const;  ///< slices that are read at once, whole blocks of them
  /// Place of a voxel in numbers of the blocks, which are at their middles.
  double in_blocks(double voxel) const { return (voxel + 0.5) / static_cast<double>(block) - 0.5; }
};

/// Means of blocks, and of each block the voxel in its middle, which has the noise of the scan. What is left at the far
/// ends, less than a block, is left out.
struct CoarseScan {
  Image<float> means, middles;
};
CoarseScan read_coarse(const FineScan& scan, const SegmentOptions& options);

}  // namespace macadam::ct
