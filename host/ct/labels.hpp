// SPDX-License-Identifier: GPL-3.0-or-later
/// \file labels.hpp  Labels of grains on the voxels of the aggregate, and shares of phases.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Labels of a coarser grid, whose voxels are `edge` fine ones wide, on the voxels of the aggregate, and from there on
/// to those that the coarser grid missed.
Image<std::uint32_t> spread(const Image<std::uint8_t>& phases, const Image<std::uint32_t>& coarse, std::int64_t edge);

/// Grains of less than `least` [m³] become no grain; the others get numbers without gaps. \returns those by the numbers
/// before.
std::vector<std::uint32_t> drop_small(Image<std::uint32_t>& labels, double least);

/// Volume of the smallest grain that is kept: a sphere of half the diameter of the smallest that matters [m³].
double least_volume(const SegmentOptions& options);

/// Shares of the phases, and the mean confidence.
void count_shares(Segmentation& out);

}  // namespace macadam::ct
