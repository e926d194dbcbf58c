// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fit_files.hpp  Writes the files of `macadam fit`.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "macadam/fit.hpp"

namespace macadam {

/// Returns a `[[contacts]]` section of a scene with the chain and its shift law; `origin` becomes a comment of one
/// line.
std::string law_toml(const laws::GeneralisedKelvin& law, const laws::Shift& shift, const std::string& origin);

/// Returns all data of a fit. `conversion`: the chain that replaces a model that is not a chain, or nullptr.
std::string fit_json(const Fit& fit, const KelvinConversion* conversion);

/// Returns one line per measurement: measured, fitted, difference.
std::string fit_csv(const Fit& fit);

/// Returns the fitted curve at the reference temperature with its 95 % limits, to half a decade beyond the data on both
/// sides.
std::string curve_csv(const Fit& fit);

/// Returns a line that names the columns of the data that were not used; empty if all are used.
std::string unused_columns_text(const ModulusData& data);

/// Returns candidates, parameters and errors as text for people.
std::string fit_text(const Fit& fit);

/// Returns a sentence about the chain that replaces a fitted model.
std::string conversion_text(const KelvinConversion& conversion, std::pair<double, double> range_hz);

/// Returns the frequency range of that chain [Hz]: as given, or the range of the data. \throws InputError when there is
/// neither.
std::pair<double, double> chain_range(std::optional<double> from, std::optional<double> to,
                                      std::optional<std::pair<double, double>> data);

/// The files of `macadam fit`: names and contents.
using FitFiles = std::map<std::string, std::string>;

/// The files of `macadam fit` and the text that it prints.
struct FitReport {
  FitFiles files;    ///< fit.json, fit.csv, curve.csv; and law.toml if there is a chain
  std::string text;  ///< for people to read
  /// Why no chain replaces the fitted 2S2P1D or Huet–Sayegh model; empty if one does. The other files are complete.
  std::string refusal;
};

/// Returns the files and the text. A model that is not a chain is converted to one that has a relative error of at most
/// `error` between `from` and `to` [Hz] (empty: the range of the data). \throws InputError when the range is invalid.
FitReport report_of(const Fit& fit, std::optional<double> from, std::optional<double> to, double error);

/// Writes the files, and removes an older law.toml if the report has none. \throws RunError when a file cannot be
/// written.
void write_report(const std::filesystem::path& folder, const FitReport& report);

/// Returns the law.toml of a model that was fitted elsewhere.
FitFiles conversion_files(const ShiftedAnalogue& model, const KelvinConversion& conversion,
                          std::pair<double, double> range_hz);
/// Writes files into a folder. \throws RunError when one cannot be written.
void write_files(const std::filesystem::path& folder, const FitFiles& files);

}  // namespace macadam
