// SPDX-License-Identifier: GPL-3.0-or-later
/// \file labels.hpp  Transfers grain numbers (labels) between grids, drops small grains, and counts the fractions of
/// the phases.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Transfers labels from a coarser grid, whose voxels are `edge` fine voxels wide, to the aggregate voxels of the fine
/// grid. Then spreads the labels step by step to connected aggregate voxels that have no label in the coarser grid.
Image<std::uint32_t> spread(const Image<std::uint8_t>& phases, const Image<std::uint32_t>& coarse, std::int64_t edge);

/// Removes grains smaller than `least` [m³] and numbers the others without gaps. Returns the new number of each old
/// number; 0 if the grain was removed.
std::vector<std::uint32_t> drop_small(Image<std::uint32_t>& labels, double least);

/// Returns the volume of the smallest grain that is kept [m³]: a sphere of half the diameter SegmentOptions::smallest.
double least_volume(const SegmentOptions& options);

/// Sets the volume fractions of the phases, and the mean confidence.
void count_shares(Segmentation& out);

}  // namespace macadam::ct
