// SPDX-License-Identifier: GPL-3.0-or-later
/// \file extrapolation.hpp  Extrapolates results of several voxel sizes to voxels of size zero.
#pragma once

#include <vector>

#include "bench/continuum/grid.hpp"

namespace continuum {

/// Results of one mixing rule for one edge of the voxels.
struct SizeResult {
  double voxel;  ///< [m]
  Complex modulus, poisson;
};
using Sizes = std::vector<SizeResult>;  ///< from the coarsest to the finest voxels

/// The limit for small voxels.
struct Limit {
  Complex modulus, poisson;
  double uncertainty = 0;        ///< of the absolute value of the modulus, in its unit
  double phase_uncertainty = 0;  ///< of its phase [rad]
};

/// Returns the common limit of both mixing rules for two or more voxel sizes, the same for both rules.
///
/// The value of a rule is e + a·h (two sizes) or e + a·h + b·h² (three, the finest ones) for edge h, with the same e
/// for both rules: least squares. The uncertainty is the largest difference from the limits of each rule alone, and
/// from the common limit by straight lines through the two finest sizes.
Limit extrapolated(const Sizes& stiff, const Sizes& soft);

}  // namespace continuum
