// SPDX-License-Identifier: GPL-3.0-or-later
/// \file statistics.hpp  What the measurements say of the parameters, and what they do not.
#pragma once

#include "host/calibration/minimise.hpp"
#include "macadam/calibration.hpp"

namespace macadam::calibration {

/// Fills in degrees of freedom, deviations, covariance, correlation and combinations. `data`: derivatives of the
/// measurements' residuals, row by row; `priors`: those of the priors; both by the logarithms of the parameters, in
/// standard deviations. What a parameter at its bound would change is left out.
void add_statistics(Calibration& out, std::vector<double> data, std::vector<double> priors);

/// "M-A.delta * M-A.E_m^-0.98": a combination in words.
std::string words(const Calibration& calibration, const Combination& combination);

}  // namespace macadam::calibration
