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

/// Names the columns of the data that were passed over, in a line; empty if all are used.
std::string unused_columns_text(const ModulusData& data);

/// Parameters as people read them, and the errors.
std::string fit_text(const Fit& fit);

/// The chain that stands for a fitted model, in words.
std::string conversion_text(const KelvinConversion& conversion, std::pair<double, double> range_hz);

/// The range of that chain [Hz]: as given, or that of the data. \throws InputError where there is neither.
std::pair<double, double> chain_range(std::optional<double> from, std::optional<double> to,
                                      std::optional<std::pair<double, double>> data);

/// What `macadam fit` leaves in its folder: names of files and their texts.
using FitFiles = std::map<std::string, std::string>;

/// What `macadam fit` writes and prints.
struct FitReport {
  FitFiles files;    ///< fit.json, fit.csv, curve.csv; and law.toml if there is a chain
  std::string text;  ///< for people to read
  /// Why no chain stands for the fitted 2S2P1D or Huet–Sayegh model; empty where one does. The other files are
  /// complete.
  std::string refusal;
};

/// Makes the files. A model that is no chain is converted to one from `from` to `to` [Hz] (empty: the range of the
/// data) with at most `error`, relative. \throws InputError for a range that makes no sense.
FitReport report_of(const Fit& fit, std::optional<double> from, std::optional<double> to, double error);

/// Writes the files; an older law.toml goes where these files have none. \throws RunError
void write_report(const std::filesystem::path& folder, const FitReport& report);

/// law.toml of a model that somebody else has fitted.
FitFiles conversion_files(const ShiftedAnalogue& model, const KelvinConversion& conversion,
                          std::pair<double, double> range_hz);
/// \throws RunError
void write_files(const std::filesystem::path& folder, const FitFiles& files);

}  // namespace macadam
