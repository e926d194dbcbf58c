// SPDX-License-Identifier: GPL-3.0-or-later
/// \file phases.hpp  Which voxel is air, mastic or aggregate.
#pragma once

#include "host/ct/grey_levels.hpp"

namespace macadam::ct {

/// Grey values that part air from mastic, and mastic from aggregate.
struct Thresholds {
  double air = 0, aggregate = 0;
};

/// Half-way between the levels, which is where a blurred plane has its place; or, where a laboratory knows the volume
/// shares, those that give them. Warns where the shares are not what the grey values say.
Thresholds thresholds_of(const Histogram& histogram, const GreyLevels& levels, const SegmentOptions& options,
                         std::vector<std::string>& warnings);

struct Phases {
  Image<std::uint8_t> phase, confidence;
};

/// The phases: each voxel's grey value, and six neighbours that rather are of the same phase (a Markov field, by
/// iterated conditional modes).
Phases classify(const Image<float>& grey, const Image<std::uint8_t>& region, const GreyLevels& levels,
                const Thresholds& thresholds);

}  // namespace macadam::ct
