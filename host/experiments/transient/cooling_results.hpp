// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cooling_results.hpp  Computes and reports fracture temperature and fracture stress of kind "cooling".
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "macadam/experiments/response.hpp"

namespace macadam {

/// Returns the results of a test that has ended. `found` has its points, its rupture, its cracks and its increments.
/// `largest`: the largest tensile stress of all increments. `temperature`: of the test.
experiments::CoolingResults cooling_results(const experiments::SteppedResponse& found, const experiments::Peak& largest,
                                            const TemperatureHistory& temperature);

/// Return the results as printed text, and add them to an entry of `results` of summary.json.
/// @{
std::string cooling_words(const experiments::CoolingResults& results);
void add_cooling(const experiments::CoolingResults& results, nlohmann::ordered_json& out);
/// @}

}  // namespace macadam
