// SPDX-License-Identifier: GPL-3.0-or-later
/// \file statistics.hpp  Computes how well the measurements determine the parameters.
#pragma once

#include "host/tools/calibration/minimise.hpp"
#include "macadam/calibration.hpp"

namespace macadam::calibration {

/// Fills in degrees of freedom, standard deviations, covariance, correlation and combinations. `data` and `priors` are
/// the derivatives of the residuals of measurements and priors with respect to the logarithms of the parameters, row by
/// row. Residuals are divided by their standard deviations. A parameter at its bound counts as fixed.
void add_statistics(Calibration& out, std::vector<double> data, std::vector<double> priors);

/// Returns the name of a combination, for example "M-A.delta * M-A.E_m^-0.98".
std::string name_of(const Calibration& calibration, const Combination& combination);

}  // namespace macadam::calibration
