// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fit_files.hpp  Writes a fit as TOML, JSON, CSV and text.
#pragma once

#include <string>

#include "macadam/fit_report.hpp"

namespace macadam {

/// Returns a `[[contacts]]` section of a scene with the chain, its shift law and the range in which it holds; `origin`
/// becomes a comment of one line.
std::string law_toml(const laws::GeneralisedKelvin& law, const laws::Shift& shift, const laws::LawRange& range,
                     const std::string& origin);

/// Returns all data of a fit. `conversion`: the chain that replaces a model that is not a chain, or nullptr.
std::string fit_json(const Fit& fit, const KelvinConversion* conversion);

/// Returns one line per measurement: measured, fitted, difference.
std::string fit_csv(const Fit& fit);

/// Returns the fitted curve at the reference temperature with its 95 % limits, to half a decade beyond the data on both
/// sides.
std::string curve_csv(const Fit& fit);

/// Returns a line that names the unused columns of the data; empty if all columns were used.
std::string unused_columns_text(const ModulusData& data);

/// Returns candidates, parameters and errors as text for people.
std::string fit_text(const Fit& fit);

}  // namespace macadam
