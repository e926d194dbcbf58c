// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fit_files.hpp  What `macadam fit` writes.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "macadam/fit.hpp"

namespace macadam {

/// A `[[contacts]]` section of a scene with the chain and its shift law; `origin` is a comment of one line.
std::string law_toml(const laws::GeneralisedKelvin& law, const laws::Shift& shift, const std::string& origin);

/// Everything about a fit, and the chain that stands for its model where that is none.
std::string fit_json(const Fit& fit, const KelvinConversion* conversion);

/// A line a measurement: measured, fitted, difference.
std::string fit_csv(const Fit& fit);

/// The fitted curve at the reference temperature with its 95 % limits, half a decade beyond the data on either side.
std::string curve_csv(const Fit& fit);

/// Parameters as people read them, and the errors.
std::string fit_text(const Fit& fit);

/// The chain that stands for a fitted model, in words.
std::string conversion_text(const KelvinConversion& conversion, std::pair<double, double> range_hz);

/// The range of that chain [Hz]: as given, or that of the data. \throws InputError where there is neither.
std::pair<double, double> chain_range(std::optional<double> from, std::optional<double> to,
                                      std::optional<std::pair<double, double>> data);

/// What `macadam fit` leaves in its folder: names of files and their texts.
using FitFiles = std::map<std::string, std::string>;
/// law.toml, fit.json, fit.csv, curve.csv; `conversion`: of a model that is no chain.
FitFiles fit_files(const Fit& fit, const KelvinConversion* conversion);
/// law.toml of a model that somebody else has fitted.
FitFiles conversion_files(const ShiftedAnalogue& model, const KelvinConversion& conversion,
                          std::pair<double, double> range_hz);
/// \throws RunError
void write_files(const std::filesystem::path& folder, const FitFiles& files);

}  // namespace macadam
