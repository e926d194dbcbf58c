// SPDX-License-Identifier: GPL-3.0-or-later
/// \file phases.hpp  Decides which voxels are air, mastic or aggregate.
#pragma once

#include "host/tools/ct/voxels/grey_levels.hpp"

namespace macadam::ct {

/// Grey values that separate air from mastic, and mastic from aggregate.
struct Thresholds {
  double air = 0, aggregate = 0;
};

/// Returns thresholds half-way between the grey levels of neighbouring phases: the blur of a scan does not move a plane
/// boundary at this grey value. If the laboratory's volume fractions are given, returns thresholds that reproduce these
/// fractions instead, and warns if the fractions do not agree with the grey values.
Thresholds thresholds_of(const Histogram& histogram, const GreyLevels& levels, const SegmentOptions& options,
                         std::vector<std::string>& warnings);

/// The phase of each voxel (VoxelPhase), and the confidence in it from 0 to 255.
struct Phases {
  Image<std::uint8_t> phase, confidence;
};

/// Assigns a phase to each voxel from its grey value and its six neighbours, which make their own phase more probable.
/// The model is a Markov random field, solved with iterated conditional modes.
Phases classify(const Image<float>& grey, const Image<std::uint8_t>& region, const GreyLevels& levels,
                const Thresholds& thresholds);

}  // namespace macadam::ct
