// SPDX-License-Identifier: GPL-3.0-or-later
/// \file misfit.hpp  Computes the differences between measured and predicted moduli, in standard deviations.
#pragma once

#include <vector>

#include "host/tools/calibration/minimise.hpp"
#include "host/tools/calibration/prepared_specimens.hpp"

namespace macadam::calibration {

/// Appends the residuals of every measurement and, row by row, their derivatives by the logarithms of the parameters.
void add_residuals(const ModulusData& data, const CalibrationOptions& options, const std::vector<Predicted>& predicted,
                   std::vector<double>& residuals, std::vector<double>& jacobian);

/// Returns the number of residuals per measurement.
int residuals_each(Misfit misfit);

}  // namespace macadam::calibration
