// SPDX-License-Identifier: GPL-3.0-or-later
/// \file standard_results.hpp  Computes and reports the results that standards define for the strength tests of discs,
/// half discs and beams.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "host/experiments/transient/peak_fit.hpp"
#include "macadam/scene.hpp"

namespace macadam {

/// Stores the results of the scene's test in `found`; does nothing for a test of another kind. `samples`: the curve, in
/// the order of time. `found.peak` must have a value.
void compute_standard_results(const Scene& scene, const Domain& domain, std::span<const StressSample> samples,
                              experiments::SteppedResponse& found);

/// Returns whether compute_standard_results() has stored results.
bool has_standard_results(const experiments::SteppedResponse& found);

/// Return the results as printed text, and add them to an entry of `results` of summary.json. There must be results.
/// `passed`: whether the test went beyond its largest load; otherwise only this load is reported.
/// @{
std::string standard_results_words(const experiments::SteppedResponse& found, bool passed);
void add_standard_results(const experiments::SteppedResponse& found, bool passed, nlohmann::ordered_json& out);
/// @}

}  // namespace macadam
