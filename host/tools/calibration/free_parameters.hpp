// SPDX-License-Identifier: GPL-3.0-or-later
/// \file free_parameters.hpp  Checks the input of a calibration, and finds the free parameters.
#pragma once

#include "host/tools/calibration/parameters.hpp"

namespace macadam::calibration {

/// \throws InputError when measurements, standard deviations or the number of seeds are invalid.
void require_valid_input(const Scene& scene, const ModulusData& data, const CalibrationOptions& options);

/// Returns the free parameters, and in `out` their values and bounds. \throws InputError for a parameter that the scene
/// does not have, and for invalid bounds or priors.
std::vector<Parameter> free_parameters(const Scene& scene, const CalibrationOptions& options,
                                       std::vector<CalibratedParameter>& out);

}  // namespace macadam::calibration
