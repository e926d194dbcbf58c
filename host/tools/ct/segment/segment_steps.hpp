// SPDX-License-Identifier: GPL-3.0-or-later
/// \file segment_steps.hpp  Declares the steps of a segmentation, with an optional last step that makes finer surfaces
/// from finer data.
#pragma once

#include "host/tools/ct/voxels/correction.hpp"
#include "host/tools/ct/grains/grain_surfaces.hpp"

namespace macadam::ct {

/// Makes finer surfaces from the full data; the scan holds only means of blocks of voxels. `steps` are the corrections
/// that were applied to the scan.
using Refine = std::function<void(Segmentation& out, const Thresholds& thresholds, const std::vector<GrainBox>& boxes,
                                  const CorrectionSteps& steps)>;

/// Does the work of segment_scan(), and then calls `refine` if it is not empty.
Segmentation segment_steps(Image<float> scan, const SegmentOptions& options, const Refine& refine);

}  // namespace macadam::ct
