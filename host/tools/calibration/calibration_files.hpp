// SPDX-License-Identifier: GPL-3.0-or-later
/// \file calibration_files.hpp  Writes the files of `macadam calibrate`, and returns the text that it prints.
#pragma once

#include <filesystem>
#include <string>

#include "macadam/calibration.hpp"

namespace macadam {

/// Returns all data of a calibration.
std::string calibration_json(const Calibration& calibration);

/// Returns one line per measurement: measured, predicted, difference.
std::string predicted_csv(const Calibration& calibration);

/// Returns parameters and errors as text for people.
std::string calibration_text(const Calibration& calibration);

/// Checks, before anything is computed or written, that write_calibration() can write. \throws InputError if the scene
/// was not read from a file, or if the folder has a scene.toml that would be overwritten and that was not written by a
/// calibration.
void require_calibration_folder(const Scene& scene, const std::filesystem::path& out);

/// Writes calibration.json, predicted.csv and scene.toml, the scene's text with the calibrated values. \throws
/// InputError as require_calibration_folder(), before a file is written.
/// \throws RunError when a file cannot be written, and when the scene.toml does not give the calibrated values when it
/// is read.
void write_calibration(const std::filesystem::path& out, const Scene& scene, const Calibration& calibration);

}  // namespace macadam
