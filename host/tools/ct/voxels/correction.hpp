// SPDX-License-Identifier: GPL-3.0-or-later
/// \file correction.hpp  Removes faults of scanners that change grey values over the scan: drift between slices, rings,
/// and beam hardening. All three compare the grey levels of the phases, not mean grey values, so that a layer with more
/// aggregate does not count as a fault.
#pragma once

#include "host/tools/ct/voxels/grey_levels.hpp"

namespace macadam::ct {

/// One correction as a function of position, so that it can also be applied to voxels of another size. Positions are
/// voxel indices of the scan in which the correction was found; they need not be whole numbers.
struct CorrectionStep {
  double black = 0;  ///< grey value that a change of brightness does not affect
  std::function<double(double i, double j, double k)> factor;  ///< divisor of grey − black; empty: 1
  std::function<double(double i, double j, double k)> offset;  ///< subtracted after the division; empty: 0
  /// Returns the corrected grey value of a voxel at (i, j, k).
  double of(double grey, double i, double j, double k) const {
    const double scaled = factor ? black + (grey - black) / factor(i, j, k) : grey;
    return offset ? scaled - offset(i, j, k) : scaled;
  }
};
using CorrectionSteps = std::vector<CorrectionStep>;

/// The functions below correct the scan in place, and append the correction to `steps` if `steps` is given. They return
/// the size of the correction as a fraction of the contrast between mastic and aggregate.
///
/// Gives every slice the grey levels of the whole scan. Returns the root mean square over the slices.
double correct_slices(Image<float>& scan, const Image<std::uint8_t>& region, CorrectionSteps* steps = nullptr);

/// Removes rings around the vertical axis through the middle of the region: changes of the levels within a few voxels
/// of radius. Returns the root mean square over the rings.
double correct_rings(Image<float>& scan, const Image<std::uint8_t>& region, CorrectionSteps* steps = nullptr);

/// Removes smooth changes of the levels over radius and height (beam hardening): fits a polynomial and divides by or
/// subtracts it. Returns the difference of the fitted grey levels between the brightest and the darkest radius.
double correct_hardening(Image<float>& scan, const Image<std::uint8_t>& region, CorrectionSteps* steps = nullptr);

/// Applies the corrections that `options` selects in turn, at most four times, until each changes less than 2 % of the
/// contrast. Returns the sizes of the corrections in the first round.
ScanCorrections correct(Image<float>& scan, const Image<std::uint8_t>& region, const SegmentOptions& options,
                        CorrectionSteps* steps = nullptr);

/// Returns the fraction of the grey values' variance that is explained by rings around the axis. Changes that are
/// smooth over the radius do not count.
double ring_share(const Image<float>& scan, const Image<std::uint8_t>& region);

/// Returns the means of blocks of voxels, and a mask that is 0 for blocks that are not entirely within the region.
std::pair<Image<float>, Image<std::uint8_t>> means_of_blocks(const Image<float>& scan,
                                                             const Image<std::uint8_t>& region,
                                                             std::array<std::int64_t, 3> block);

}  // namespace macadam::ct
