// SPDX-License-Identifier: GPL-3.0-or-later
/// \file forecast_parts.hpp  Declares the parts of the forecast: steps, solutions, files.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "host/simulation/forecast.hpp"

namespace macadam {

/// Returns the scale of the stiffness of contacts of a pair [Pa], the force per area divided by the strain along the
/// line of centres, for a law with the stiffness `k`. With rule "series" part of the line of centres is rock: half of
/// it between mastic and aggregate, as between spheres of equal size, and nine tenths of it between two aggregates.
inline double with_rock(const Scene& scene, PairType pair, double k) {
  if (scene.network.rule == ContactRule::centres || !scene.materials.rock_modulus) return k;
  const double rock = pair == PairType::ma ? 0.5 : pair == PairType::aa ? 0.9 : 0;
  return 1 / ((1 - rock) / k + rock / *scene.materials.rock_modulus);
}

/// Returns the mean of f(law, pair) over the pair types that have most of the contacts. These are the pairs with
/// mastic, if the scene has any.
template <class F>
std::optional<double> mean_of_usual(const Scene& scene, F&& f) {
  double sum = 0;
  int count = 0;
  for (const PairType pair : {PairType::mm, PairType::ma, PairType::inner, PairType::aa}) {
    if (count > 0 && pair > PairType::ma) break;
    if (const auto& law = scene.laws[static_cast<std::size_t>(pair)]) sum += f(*law, pair), ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// Predicts the time steps for each frequency or, if the experiment has no frequencies, for the load history.
std::vector<StepForecast> forecast_steps(const Scene& scene, const Census& census);

/// Returns the contrast (stiffest over softest contact) of each solution in the frequency domain.
std::vector<double> forecast_contrasts(const Scene& scene, bool stepped);

/// Adds names and sizes of the files that a run leaves. Everything in the forecast except memory and times must be set.
void forecast_files(const Scene& scene, Forecast& forecast);

}  // namespace macadam
