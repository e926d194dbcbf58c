// SPDX-License-Identifier: GPL-3.0-or-later
/// \file calibration_files.hpp  What `macadam calibrate` writes and says.
#pragma once

#include <filesystem>
#include <string>

#include "macadam/calibration.hpp"

namespace macadam {

/// Everything about a calibration.
std::string calibration_json(const Calibration& calibration);

/// A line a measurement: measured, predicted, difference.
std::string predicted_csv(const Calibration& calibration);

/// Parameters and errors as people read them.
std::string calibration_text(const Calibration& calibration);

/// \throws InputError for a folder with a scene.toml that would be replaced and that no calibration wrote.
void require_calibration_folder(const Scene& scene, const std::filesystem::path& out);

/// calibration.json, predicted.csv and, of a scene that was read from a text, scene.toml with the calibrated values.
/// \throws RunError, also where the text of the scene could not be made to say what was found.
void write_calibration(const std::filesystem::path& out, const Scene& scene, const Calibration& calibration);

}  // namespace macadam
