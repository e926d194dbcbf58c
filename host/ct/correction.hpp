// SPDX-License-Identifier: GPL-3.0-or-later
/// \file correction.hpp  Faults of scanners that change grey values over the scan: slices that drift, rings, beam
/// hardening. All three look at the levels of the phases, never at means: a layer of more aggregate is no fault.
#pragma once

#include "host/ct/grey_levels.hpp"

namespace macadam::ct {

/// What was taken out of a scan, as a function of the place: of use for voxels of another size too. Places are numbers
/// of the voxels of the scan that it was found in, and need not be whole.
struct CorrectionStep {
  double black = 0;  ///< the grey value that a change of brightness leaves alone
  std::function<double(double i, double j, double k)> factor;  ///< what divides grey − black; none: 1
  std::function<double(double i, double j, double k)> offset;  ///< what is then taken away; none: 0
  double of(double grey, double i, double j, double k) const {
    const double scaled = factor ? black + (grey - black) / factor(i, j, k) : grey;
    return offset ? scaled - offset(i, j, k) : scaled;
  }
};
using CorrectionSteps = std::vector<CorrectionStep>;

/// Every slice gets the levels of the whole scan. What is done is added to `steps`, if any, here and below.
double correct_slices(Image<float>& scan, const Image<std::uint8_t>& region, CorrectionSteps* steps = nullptr);

/// Rings around the vertical axis through the middle of the region: what of the levels changes within a few voxels of
/// radius is taken away.
double correct_rings(Image<float>& scan, const Image<std::uint8_t>& region, CorrectionSteps* steps = nullptr);

/// Levels that change smoothly over radius and height: a polynomial, fitted and taken away.
double correct_hardening(Image<float>& scan, const Image<std::uint8_t>& region, CorrectionSteps* steps = nullptr);

/// Those that were asked for, in turn, until nothing changes any more.
ScanCorrections correct(Image<float>& scan, const Image<std::uint8_t>& region, const SegmentOptions& options,
                        CorrectionSteps* steps = nullptr);

/// Share of the variance of grey values that their means over rings around the axis explain, less what changes smoothly
/// over radius.
double ring_share(const Image<float>& scan, const Image<std::uint8_t>& region);

/// Means of blocks of voxels; blocks that the region does not fill are 0 in the second image.
std::pair<Image<float>, Image<std::uint8_t>> means_of_blocks(const Image<float>& scan,
                                                             const Image<std::uint8_t>& region,
                                                             std::array<std::int64_t, 3> block);

}  // namespace macadam::ct
