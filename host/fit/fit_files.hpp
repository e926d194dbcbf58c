// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fit_files.hpp  What `macadam fit` writes.
#pragma once

#include <string>

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

}  // namespace macadam
