// SPDX-License-Identifier: GPL-3.0-or-later
// finished_frequency.cpp  Evaluates the cycles of a frequency and compares them with the harmonic solution.
#include "host/experiments/cyclic/finished_frequency.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "host/experiments/cyclic/methods.hpp"
#include "host/run/error_model.hpp"

namespace macadam {

using experiments::SteppedFrequency;

namespace {

/// Returns the result of cycles that could not be completed: all numbers are NaN.
CyclicResult without_result() {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {{none, none}, {none, none}, none, none, none, {}};
}

}  // namespace

std::span<const ResponseSample> samples_of(const std::vector<ResponseSample>& samples, std::size_t first,
                                           double frequency) {
  std::size_t end = first;
  while (end < samples.size() && samples[end].frequency_hz == frequency) ++end;
  return std::span(samples).subspan(first, end - first);
}

std::vector<Stiffness> stiffness_of_cycles(std::span<const ResponseSample> samples, double frequency) {
  std::vector<Stiffness> out;
  if (samples.size() < 2) return out;
  const double spacing = samples[1].time_s - samples[0].time_s;
  const auto per_cycle = static_cast<std::size_t>(std::llround(1 / (frequency * spacing)));
  for (std::size_t begin = 0; begin + per_cycle < samples.size(); begin += per_cycle)
    out.push_back(evaluate_cyclic(samples.subspan(begin, per_cycle + 1), frequency, 1).fit);
  return out;
}

SteppedFrequency finished_frequency(const Scene& scene, const Plan& whole, std::size_t number,
                                    std::span<const ResponseSample> samples, double seconds,
                                    const std::optional<experiments::Rupture>& rupture) {
  const FrequencyPlan& plan = whole.frequencies[number];
  const double frequency = plan.loading.frequency;
  const CyclicResult cyclic = rupture ? without_result() : evaluate_cyclic(samples, frequency, plan.fit_cycles);
  SteppedFrequency f;
  static_cast<experiments::Frequency&>(f) =
      frequency_of(scene, frequency, scene.materials.temperature, plan.density_scaling, cyclic.fit, seconds);
  f.cyclic = cyclic;
  f.poisson_ratio = cyclic.poisson_ratio;
  f.dt_s = plan.loading.dt();
  f.cycles = plan.cycles;
  f.start = plan.start;
  f.steps = plan.loading.steps_per_period * plan.cycles;
  f.predicted = plan.predicted;
  f.rupture = rupture;
  if (rupture) {
    f.steps = std::llround(rupture->time_s / f.dt_s);
    return f;
  }
  const std::optional<double>& tolerance = scene.solver.tolerance;
  if (plan.known) f.achieved = difference(f.stiffness, *plan.known);
  if (plan.known && tolerance) f.kept = largest(*f.achieved) + whole.geometry_error <= *tolerance;
  return f;
}

}  // namespace macadam
