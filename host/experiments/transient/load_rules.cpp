// SPDX-License-Identifier: GPL-3.0-or-later
// load_rules.cpp  Computes ramp, damping and time step from the slowest wave of the specimen and the times of the
// result's points.
#include "host/experiments/transient/load_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "host/run/step_settings.hpp"

namespace macadam {
namespace {

/// Largest amplitude of a wave, relative to the stress, that is allowed at the time of a point.
constexpr double largest_wave = 2e-5;

/// Returns the shortest time from a change of the load's rate to the next point of the result [s].
double shortest_pause(const TransientExperiment& test, double ramp) {
  std::vector<double> changes{0};
  if (!test.grows) changes.push_back(ramp);
  if (test.when.release) changes.insert(changes.end(), {*test.when.release, *test.when.release + ramp});
  double out = std::numeric_limits<double>::infinity();
  for (const double t : test.history.times) {
    double pause = t;
    for (const double change : changes) {
      if (t > change * (1 + 1e-9)) pause = std::min(pause, t - change);
    }
    out = std::min(out, pause);
  }
  for (const double jump : test.jumps) {
    const auto& times = test.history.times;
    const auto next = std::upper_bound(times.begin(), times.end(), jump * (1 + 1e-9));
    if (next != times.end()) out = std::min(out, *next - jump);
  }
  return out;
}

}  // namespace

double slowest_period(const TransientExperiment& test, double height, double modulus, double density) {
  return (test.by_stress ? 4 : 2) * height / std::sqrt(modulus / density);
}

double ramp_of(const TransientExperiment& test, double slowest) {
  const double given = test.grows ? test.history.times.back() : test.when.ramp;
  return given > 0 ? given : slowest;
}

bool starts_in_motion(const TransientExperiment& test, const FactsTable& laws) {
  return test.grows && !test.by_stress && !test.reverses && can_crack(laws);
}

// Weak damping leaves waves, and strong damping delays the slow motion. Therefore β is the smallest value with which
// the waves have decayed by the times of the points of the result. A ramp causes waves. Their amplitude relative to the
// stress is the time that a wave takes through the specimen, divided by the duration of the ramp. After a time t,
// viscous damping leaves the fraction e^(−β·t/2) of this amplitude.
LoadDamping damping_of(const TransientExperiment& test, const SolverSpec& solver, const FactsTable& laws, double ramp,
                       double slowest) {
  LoadDamping out{solver.damping_kind, solver.damping};
  if (solver.damping_given) return out;
  if (starts_in_motion(test, laws)) {
    constexpr double against_sliding = 0.05;  // this damping takes less than a thousandth of the work
    const bool compresses = test.strain.value_or(0) < 0;
    return compresses ? LoadDamping{Damping::local, against_sliding} : LoadDamping{};
  }
  out.pause = shortest_pause(test, ramp);
  const double grown = std::min(ramp, test.history.times.front()), waves = std::min(1.0, 0.5 * slowest / grown);
  const double critical = 4 * std::numbers::pi / slowest;
  const double enough = 2 * std::max(1.0, std::log(waves / largest_wave)) / out.pause;
  out.kind = Damping::viscous;
  out.value = std::min(critical, enough);
  out.chosen = true, out.critical = enough >= critical;
  return out;
}

double load_step(const TransientExperiment& test, const SolverSpec& solver, double critical, double density_scaling,
                 double ramp, const LoadDamping& damping) {
  constexpr double usual_safety = 0.8;
  const double safe = solver.safety.value_or(usual_safety) * critical * std::sqrt(density_scaling);
  double step = solver.time_step.value_or(safe);
  // so that several steps resolve the decay by damping
  if (damping.kind == Damping::viscous && !solver.time_step) step = std::min(step, 1 / damping.value);
  const double end = test.history.times.back();
  require_possible(end / step, step, fmt::format("until {:g} s", end));
  require_possible(ramp / step, step, fmt::format("in the ramp of {:g} s", ramp));
  return test.step ? test.step(step) : ramp / std::ceil(ramp / step);
}

}  // namespace macadam
