// SPDX-License-Identifier: GPL-3.0-or-later
/// \file free_parameters.hpp  What a calibration was asked for, checked.
#pragma once

#include "host/calibration/parameters.hpp"

namespace macadam::calibration {

/// \throws InputError for measurements, deviations or seeds without sense.
void require_sense(const Scene& scene, const ModulusData& data, const CalibrationOptions& options);

/// The free parameters, and in `out` their values and bounds. \throws InputError for what the scene does not have, and
/// for bounds or priors without sense.
std::vector<Parameter> free_parameters(const Scene& scene, const CalibrationOptions& options,
                                       std::vector<CalibratedParameter>& out);

}  // namespace macadam::calibration
