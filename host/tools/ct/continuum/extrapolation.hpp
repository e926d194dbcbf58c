// SPDX-License-Identifier: GPL-3.0-or-later
/// \file extrapolation.hpp  Extrapolates results of several voxel sizes to voxels of size zero.
#pragma once

#include <vector>

#include "host/tools/ct/continuum/grid.hpp"

namespace macadam::continuum {

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
/// The difference g of the rules' moduli tends to zero with the voxels, at a rate that depends on the films between the
/// aggregates. So the results are extrapolated in g instead of the edge: a polynomial through the results of the three
/// finest sizes (two, if there are only two), evaluated at g = 0. The uncertainty is the larger of two differences:
/// from the straight line through the two finest sizes, and from this line to the finest soft result. If g falls by
/// less than 20 % from the second finest to the finest size, the limit is the finest soft result, and the uncertainty
/// is g. If no voxel of the finest size is cut, its result is the limit, and the uncertainty is the difference from the
/// result of the next coarser size.
Limit extrapolated(const Sizes& stiff, const Sizes& soft);

}  // namespace macadam::continuum
