// SPDX-License-Identifier: GPL-3.0-or-later
/// \file refine.hpp  Makes finer surfaces of small grains: the grains were found on a coarse grid, their surfaces are
/// made from the voxels of the file.
#pragma once

#include "host/tools/ct/segment/coarse_scan.hpp"
#include "host/tools/ct/segment/segment_steps.hpp"

namespace macadam::ct {

/// Makes new surfaces for the grains that have too few blocks along their intermediate side for a good surface. The
/// nodes of the new surfaces are means of smaller blocks, which are read in one pass over the file. The corrections
/// that were found for the coarse scan are applied to these means. `noise` is the standard deviation of the voxels
/// [contrasts]. A grain whose new surface cannot be made keeps the old one. \returns the number of grains with a new
/// surface.
std::size_t refine_surfaces(const FineScan& scan, Segmentation& out, const Thresholds& thresholds,
                            const std::vector<GrainBox>& boxes, const CorrectionSteps& steps, double noise,
                            const SegmentOptions& options);

}  // namespace macadam::ct
