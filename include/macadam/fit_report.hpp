// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fit_report.hpp  Declares the files and the text that `macadam fit` makes of a fit.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "macadam/fit.hpp"

namespace macadam {

/// The files of `macadam fit` and the text that it prints.
struct FitReport {
  /// Contents by name: fit.json, fit.csv, curve.csv, and law.toml if there is a chain. A report of
  /// report_conversion() has only law.toml.
  std::map<std::string, std::string> files;
  std::string text;  ///< text that is printed
  /// The reason if no chain could be found that replaces the fitted 2S2P1D or Huet–Sayegh model; otherwise empty. The
  /// files except law.toml are complete in either case.
  std::string refusal;
};

/// Returns the files and the text of a fit. A model that is not a chain is converted to one that has a relative error
/// of at most `error` between `from` and `to` [Hz] (empty: the ends of the data's range). \throws InputError if the
/// range is invalid.
FitReport report_of(const Fit& fit, std::optional<double> from, std::optional<double> to, double error);

/// Converts a model that was fitted elsewhere into a chain as report_of() does, and returns law.toml and the text.
/// \throws InputError if one end of the range is missing, and as to_kelvin().
FitReport report_conversion(const ShiftedAnalogue& model, std::optional<double> from, std::optional<double> to,
                            double error);

/// Returns law.toml and the text for a chain that approximates a curve (chain_of_curve()). The chain holds between the
/// lowest and the highest frequency of the curve.
FitReport report_of(const CurveChain& chain, const ModulusData& curve, const laws::Shift& shift = laws::NoShift{});

/// Writes the files, and removes an older law.toml if the report has none. \throws RunError if a file cannot be
/// written; InputError if another command is writing into the folder.
void write_report(const std::filesystem::path& folder, const FitReport& report);

}  // namespace macadam
