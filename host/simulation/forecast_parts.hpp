// SPDX-License-Identifier: GPL-3.0-or-later
/// \file forecast_parts.hpp  Parts of the forecast: steps, solutions, files.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "host/simulation/forecast.hpp"

namespace macadam {

/// The mean of f(law) over the pairs of most contacts: the pairs of the mastic, if there is any.
template <class F>
std::optional<double> mean_of_usual(const Scene& scene, F&& f) {
  double sum = 0;
  int count = 0;
  for (const PairType pair : {PairType::mm, PairType::ma, PairType::inner, PairType::aa}) {
    if (count > 0 && pair > PairType::ma) break;
    if (const auto& law = scene.laws[static_cast<std::size_t>(pair)]) sum += f(*law), ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// Steps of each frequency, or of the load.
std::vector<StepForecast> forecast_steps(const Scene& scene, const Census& census);

/// For each solution in the frequency domain, stiffest over softest contact.
std::vector<double> forecast_contrasts(const Scene& scene, bool stepped);

/// Names and sizes of the files that a run leaves. Needs all but the times of the forecast.
void forecast_files(const Scene& scene, Forecast& forecast);

}  // namespace macadam
