// SPDX-License-Identifier: GPL-3.0-or-later
/// \file refine.hpp  Surfaces of small grains from the file itself, where grains were found on a coarser grid.
#pragma once

#include "host/ct/coarse_scan.hpp"
#include "host/ct/segment_steps.hpp"

namespace macadam::ct {

/// Draws the surfaces of grains anew that have fewer blocks through their middle side than a surface has nodes: through
/// means of smaller blocks, read in one pass over the file. What was taken out of the scan is taken out of these.
/// `noise`: standard deviation of the voxels [contrasts]. A grain whose new surface cannot be made keeps the old one.
/// \returns how many have a new one.
std::size_t refine_surfaces(const FineScan& scan, Segmentation& out, const Thresholds& thresholds,
                            const std::vector<GrainBox>& boxes, const CorrectionSteps& steps, double noise,
                            const SegmentOptions& options);

}  // namespace macadam::ct
