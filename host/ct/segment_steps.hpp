// SPDX-License-Identifier: GPL-3.0-or-later
/// \file segment_steps.hpp  The steps of a segmentation, with a place for surfaces that are drawn from finer data.
#pragma once

#include "host/ct/correction.hpp"
#include "host/ct/grain_surfaces.hpp"

namespace macadam::ct {

/// Draws surfaces anew, from data that the scan is the block means of. `steps`: what was taken out of the scan.
using Refine = std::function<void(Segmentation& out, const Thresholds& thresholds, const std::vector<GrainBox>& boxes,
                                  const CorrectionSteps& steps)>;

/// segment_scan(); at the end `refine`, where there is one.
Segmentation segment_steps(Image<float> scan, const SegmentOptions& options, const Refine& refine);

}  // namespace macadam::ct
