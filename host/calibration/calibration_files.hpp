// SPDX-License-Identifier: GPL-3.0-or-later
/// \file calibration_files.hpp  What `macadam calibrate` writes and says.
#pragma once

#include <string>

#include "macadam/calibration.hpp"

namespace macadam {

/// Everything about a calibration.
std::string calibration_json(const Calibration& calibration);

/// A line a measurement: measured, predicted, difference.
std::string predicted_csv(const Calibration& calibration);

/// Parameters and errors as people read them.
std::string calibration_text(const Calibration& calibration);

}  // namespace macadam
