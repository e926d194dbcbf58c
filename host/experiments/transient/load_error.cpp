// SPDX-License-Identifier: GPL-3.0-or-later
// load_error.cpp  Computes the errors of a stepped test as differences from the response that is computed without time
// steps. If that response is not known, estimates the errors from the ramp, the damping and the forces on the walls.
#include "host/experiments/transient/load_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "host/experiments/transient/load_rules.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::ResponsePoint;
using experiments::SteppedPoint;

namespace {

/// Relative tolerance with which E(t) is computed if errors of steps are measured against it.
constexpr double spectrum_tolerance = 1e-5;
/// Largest strain at which the change of the geometry may be neglected. The change of the geometry changes stresses by
/// a fraction of about three times the strain, that is, by 0.3 % at this strain.
constexpr double small_strain = 1e-3;
/// A row of the result with a larger error than this is named in a warning.
constexpr double largest_error = 1e-2;

/// Returns the times of a load as in the run, where the release is rounded to a whole step. A load that is removed at
/// once is still held at the step of the release.
LoadTimes on_steps(const LoadTimes& asked, double ramp, double dt) {
  LoadTimes out{ramp, {}};
  if (!asked.release) return out;
  const double step = static_cast<double>(std::llround(*asked.release / dt)) * dt;
  out.release = ramp > 0 ? step : step * (1 + 1e-12);
  return out;
}

/// Returns the largest absolute value of a quantity among the row and the rows before it.
template <class F>
double largest_of(const SteppedPoint& row, const std::vector<SteppedPoint>& before, F&& of) {
  double out = std::abs(of(row));
  for (const SteppedPoint& p : before) out = std::max(out, std::abs(of(p)));
  return out;
}

/// Returns the range of times after a change of the load for which the relaxation must be known to compute the rows of
/// the result. The range covers both the ramp of the scene and the ramp of the run.
std::pair<double, double> range_of(const TransientExperiment& test, const LoadPlan& plan) {
  std::vector<double> times;
  for (const double t : test.history.times) times.push_back(static_cast<double>(plan.step_at(t)) * plan.dt);
  std::pair<double, double> out{std::numeric_limits<double>::infinity(), 0};
  for (const double ramp : {test.grows ? plan.ramp : test.when.ramp, plan.ramp}) {
    const LoadTimes when = on_steps(test.when, ramp, plan.dt);
    History history{times, {{0, ramp}}, test.history.shortest_change};
    if (when.release) history.ramps.push_back({*when.release, ramp});
    const auto [shortest, longest] = history.range();
    out = {std::min(out.first, shortest), std::max(out.second, longest)};
  }
  return out;
}

}  // namespace

std::optional<UnsteppedAnswer> solve_unstepped(const TransientExperiment& test, const Scene& scene,
                                               const Preparation& prepared, const Watcher& watcher, Backend backend,
                                               LoadPlan& plan) {
  if (!test.temperature.empty()) {
    plan.decisions.emplace_back(
        "errors are estimates, because the temperature changes during the test, and the solution without time steps "
        "has one temperature");
    return {};
  }
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const auto law = facts_of(scene.laws)[pair];
    if (!law || law->linear) continue;
    plan.decisions.push_back(
        fmt::format("errors are estimates, because law {} of {} is not linear, and only linear laws have a "
                    "solution without time steps",
                    law->name, to_string(static_cast<PairType>(pair))));
    return {};
  }
  SpectrumOptions options;
  std::tie(options.shortest, options.longest) = range_of(test, plan);
  options.tolerance = spectrum_tolerance;
  options.backend = backend == Backend::cuda ? Backend::cuda : Backend::cpu;
  if (options.backend == Backend::cuda) options.devices = scene.solver.devices;
  options.linear = scene.solver.linear;
  options.stop = watcher.stop;
  options.on_progress = [&](int solutions, double error) {
    if (watcher.progress) {
      watcher.progress(fmt::format("solution without time steps: {} frequencies, error {:.1e}", solutions, error),
                       std::min(1.0, std::log(error) / std::log(spectrum_tolerance)));
    }
  };
  try {
    const Spectrum found = spectrum_of(prepared.specimen, prepared.network, scene.laws, options);
    plan.decisions.push_back(
        fmt::format("errors are differences from the solution without time steps, which is computed from the "
                    "relaxation modulus E(t) of the specimen; {} solutions in the frequency domain give E(t) from "
                    "{:.3g} to {:.3g} s with a relative error of {:.1e}",
                    found.solutions, options.shortest, options.longest, std::max(found.error, found.checked)));
    return UnsteppedAnswer{found.relaxation, std::max(found.error, found.checked)};
  } catch (const InterruptedError&) { throw; } catch (const Error& error) {
    plan.decisions.push_back(fmt::format(
        "errors are estimates, because the solution without time steps could not be computed: {}", error.what()));
    return {};
  }
}

LoadErrors::LoadErrors(const TransientExperiment& test, const Scene& scene, const Preparation& prepared,
                       double heavy_density, const LoadPlan& plan, const std::optional<UnsteppedAnswer>& unstepped)
    : test_(test), plan_(plan), asked_(on_steps(test.when, test.when.ramp, plan.dt)) {
  run_ = on_steps(test.when, plan.ramp, plan.dt);
  if (unstepped) {
    spectrum_.emplace();
    spectrum_->relaxation = unstepped->relaxation;
    spectrum_->creep = creep_series(unstepped->relaxation);
    spectrum_->error = unstepped->error;
  }
  updated_ = plan.geometry == Geometry::updated;
  damping_given_ = scene.solver.damping_given;
  in_motion_ = starts_in_motion(test, facts_of(scene.laws));
  for (const auto& law : facts_of(scene.laws)) remembers_ = remembers_ || (law && std::isfinite(law->shortest_time));
  const Box& box = prepared.specimen.box;
  affine_modulus_ = affine_modulus(prepared.network, facts_of(scene.laws), box.volume());
  wave_ = std::numbers::pi * std::numbers::pi / (heavy_density * gauge_length(box) * gauge_length(box)) *
          (test.by_stress ? 0.25 : 1);
}

double LoadErrors::of(const SteppedPoint& row, const std::vector<SteppedPoint>& before) const {
  if (is_known(row, before)) {
    const ResponsePoint asked = test_.unstepped(*spectrum_, row.time_s, asked_);
    const double scale =
        test_.reverses
            ? largest_of(row, before, [&](const SteppedPoint& p) { return value(p); })
            : std::abs(value(is_released(row.time_s) ? test_.unstepped(*spectrum_, *asked_.release, asked_) : asked));
    if (scale == 0) return std::abs(value(asked)) > 0 ? 1 : spectrum_->error;  // the specimen has not been loaded
    return std::abs(value(row) - value(asked)) / scale + spectrum_->error;
  }
  const Parts parts = estimated(row, before);
  return parts.ramp + parts.remainder;
}

bool LoadErrors::is_known(const SteppedPoint& row, const std::vector<SteppedPoint>& before) const {
  if (!spectrum_) return false;
  double strain = std::abs(row.strain);
  for (const SteppedPoint& p : before) strain = std::max(strain, std::abs(p.strain));
  // a larger strain turns the contacts, and the relaxation spectrum does not contain this effect
  return !updated_ || strain <= small_strain;
}

/// Returns the error of a row as the difference from the response without time steps, in two parts: the effect of the
/// run's ramp, and the remainder.
LoadErrors::Parts LoadErrors::measured(const SteppedPoint& row) const {
  const double asked = value(test_.unstepped(*spectrum_, row.time_s, asked_)),
               run = value(test_.unstepped(*spectrum_, row.time_s, run_));
  return {std::abs(run - asked), std::abs(value(row) - run)};
}

/// Returns the relative difference between the stresses on the two walls. If the load is a stress, returns the largest
/// relative difference among this stress and the stresses on the two walls.
double LoadErrors::walls(const SteppedPoint& row) const {
  const double apart = std::abs(row.top_pa - row.bottom_pa);
  if (test_.by_stress) {
    return std::max({std::abs(row.stress_pa - row.top_pa), std::abs(row.stress_pa - row.bottom_pa), apart}) /
           std::abs(test_.held_stress);
  }
  const double top = std::abs(row.top_pa), bottom = std::abs(row.bottom_pa);
  // The smaller stress counts as at least this fraction of the larger stress. So the relative difference stays finite
  // while a wave has not yet reached the other wall.
  constexpr double least = 1e-3;
  const double smaller = std::max(std::min(top, bottom), least * std::max(top, bottom));
  return smaller > 0 ? apart / smaller : 0;
}

/// Returns stress over strain at the row; after a release, the held stress over the largest strain. The result is at
/// most the affine modulus.
double LoadErrors::modulus(const SteppedPoint& row, const std::vector<SteppedPoint>& before) const {
  double strain = std::abs(row.strain);
  if (is_released(row.time_s)) {
    for (const SteppedPoint& p : before) strain = std::max(strain, std::abs(p.strain));
  }
  const double stress = std::abs(is_released(row.time_s) ? test_.held_stress : row.stress_pa);
  return std::min(stress / strain, affine_modulus_);
}

/// Returns an upper bound of the relative rate of change [1/s] of E(t) or J(t) over the last `window` seconds before
/// the row. E(t) is convex and J(t) is concave. So in the last part of any interval E(t) and J(t) change no faster than
/// on average over the whole interval.
double LoadErrors::rate(const SteppedPoint& row, const std::vector<SteppedPoint>& before, double modulus,
                        double window) const {
  if (test_.grows) return 1 / row.time_s;
  if (is_released(row.time_s)) return 1 / (row.time_s - *asked_.release);
  const auto change = [&](double earlier) {
    return test_.by_stress ? 1 - modulus / earlier : std::abs(earlier) / modulus - 1;
  };
  double out = std::max(0.0, change(affine_modulus_)) / row.time_s;
  if (before.empty() || before.back().time_s < plan_.ramp || row.time_s - before.back().time_s < window) return out;
  const double earlier = std::abs(before.back().stress_pa / before.back().strain);
  return std::min(out, std::abs(change(earlier)) / (row.time_s - before.back().time_s));
}

// The run's ramp replaces an instantaneous load. During the ramp, of duration r, a part of the load is missing;
// afterwards the load is r/2 late. Viscous damping β delays the particles by β/ω², where ω is the frequency of the
// slowest wave, and inertia delays them by up to 1/ω.
LoadErrors::Parts LoadErrors::estimated(const SteppedPoint& row, const std::vector<SteppedPoint>& before) const {
  if (test_.reverses) return {0, estimated_of_history(row, before)};
  if (in_motion_) {
    // the sum of all forces of inertia and damping is the difference between the two walls
    const double stress = largest_of(row, before, [](const SteppedPoint& p) { return p.stress_pa; });
    return {0, stress > 0 ? std::abs(row.top_pa - row.bottom_pa) / stress : 0};
  }
  const double stiffness = modulus(row, before), omega = std::sqrt(wave_ * stiffness);
  const double drag = plan_.damping_kind == Damping::viscous ? plan_.damping / (omega * omega) : 0;
  const double late = drag + 1 / omega, ramp = !test_.grows && asked_ramp() == 0 ? plan_.ramp : 0;
  const double changes = remembers_ ? rate(row, before, stiffness, ramp + 2 * late) : 0;
  const double since = is_released(row.time_s) ? row.time_s - *asked_.release : row.time_s;
  const double missing = since < ramp ? 1 - since / ramp : 0;
  return {missing + std::min(1.0, changes * ramp / 2), walls(row) + std::min(1.0, changes * late)};
}

/// Returns the estimated error of a row of a strain history, relative to the largest stress so far: the difference
/// between the stresses on the two walls, plus the largest change of the stress within the time by which the particles
/// lag behind the wall. The estimate assumes that the stress changes as fast as the strain.
double LoadErrors::estimated_of_history(const SteppedPoint& row, const std::vector<SteppedPoint>& before) const {
  const double stress = largest_of(row, before, [](const SteppedPoint& p) { return p.stress_pa; });
  const double strain = largest_of(row, before, [](const SteppedPoint& p) { return p.strain; });
  if (stress == 0) return 0;
  const double stiffness = strain > 0 ? std::min(stress / strain, affine_modulus_) : affine_modulus_;
  const double omega = std::sqrt(wave_ * stiffness);
  const double drag = plan_.damping_kind == Damping::viscous ? plan_.damping / (omega * omega) : 0;
  const double late = (drag + 1 / omega) / std::min(row.time_s, test_.history.shortest_change);
  return std::abs(row.top_pa - row.bottom_pa) / stress + std::min(1.0, late);
}

std::string LoadErrors::ramp_words() const {
  if (!spectrum_ || test_.grows) return {};
  double largest = 0, at = 0;
  for (const double asked : test_.history.times) {
    const double t = static_cast<double>(plan_.step_at(asked)) * plan_.dt;
    if (t < plan_.ramp || is_released(t)) continue;
    const ResponsePoint p = test_.unstepped(*spectrum_, t, run_);
    const double load = test_.by_stress ? p.stress_pa : p.strain;
    const double effect = std::abs(value(p) / load / p.ratio - 1);
    if (effect > largest) largest = effect, at = t;
  }
  if (largest == 0) return {};
  return fmt::format(
      "the ramp of {:.3g} s, in place of an instantaneous load, changes {} by at most {:.1e} (at t = {:.4g} s)",
      plan_.ramp, test_.by_stress ? "J(t)" : "E(t)", largest, at);
}

std::string LoadErrors::meaning() const {
  const char* of = test_.by_stress ? "strain" : "stress";
  if (test_.reverses) {
    return fmt::format("error: {}", spectrum_
                                        ? "difference of the stress from the solution without time steps, divided "
                                          "by the largest stress so far"
                                        : "estimated error of the stress, divided by the largest stress so far");
  }
  if (in_motion_ && !spectrum_) return "error: estimated error of the stress, divided by the largest stress so far";
  if (!spectrum_) return fmt::format("error: estimated relative error of the {}", of);
  return fmt::format("error: relative difference of the {} from the solution without time steps{}", of,
                     updated_ ? "; an estimate once the strain has exceeded 0.1 %" : "");
}

std::string LoadErrors::warning(const std::vector<SteppedPoint>& rows) const {
  const auto worst =
      std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
  if (worst == rows.end() || worst->error <= largest_error) return {};
  const auto count = std::count_if(rows.begin(), rows.end(), [](const auto& p) { return p.error > largest_error; });
  const std::vector<SteppedPoint> before(rows.begin(), worst);
  const bool known = is_known(*worst, before);
  const std::string size = worst->error > 1 ? "more than 100" : fmt::format("{:.1f}", 100 * worst->error);
  return fmt::format(
      "the error is above 1 % in {} of {} rows, largest at t = {:.4g} s: {} {} %; {}", count, rows.size(),
      worst->time_s,
      known ? "there the result differs from the solution without time steps by" : "there the error is estimated as",
      size, advice(known ? measured(*worst) : estimated(*worst, before)));
}

/// Returns advice for the warning: which part of the error is larger, and what reduces this part.
std::string LoadErrors::advice(const Parts& parts) const {
  const std::string lighter =
      plan_.density_scaling > 1 ? fmt::format(", a smaller density_scaling (now {:g})", plan_.density_scaling) : "";
  if (parts.ramp > parts.remainder) {
    return fmt::format(
        "most of the error comes from the ramp of {:.3g} s in place of an instantaneous load; later times{} or a ramp "
        "in [loading] reduce the error",
        plan_.ramp, lighter);
  }
  const std::string weaker = damping_given_ && plan_.damping > 0
                                 ? fmt::format(", a smaller damping (now {:g})", plan_.damping)
                                 : std::string();
  if (in_motion_) {
    return fmt::format("most of the error comes from inertia and damping; these changes reduce it: a lower rate{}{}",
                       lighter, weaker);
  }
  return fmt::format(
      "most of the error comes from inertia and damping; a longer ramp{}{} or samples at later times reduce the error",
      lighter, weaker);
}

}  // namespace macadam
