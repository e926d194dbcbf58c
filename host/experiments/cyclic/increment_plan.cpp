// SPDX-License-Identifier: GPL-3.0-or-later
// increment_plan.cpp  Chooses start, cycles and samples of a cyclic test by increments, and makes its steppers.
#include "host/experiments/cyclic/increment_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiments/cyclic/step_rules.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/run/harmonic_options.hpp"
#include "host/run/phases.hpp"
#include "host/run/step_settings.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr std::int64_t units_per_sample = 1000;
/// Largest number of samples of a frequency. Each one is kept in memory, and needs a linear system at least.
constexpr std::int64_t most_samples = 10'000'000;
/// From rest, the first increment is this fraction of a sample, because the load sets in suddenly.
constexpr std::int64_t first_fraction = 20;
/// A steady start is the state at time 0 to this part of a period. steady_start() gives the state one step earlier.
constexpr std::int64_t steps_of_start = 1'000'000'000;

/// Solves all frequencies without inertia. Returns nothing, and appends the reason to the decisions, if there is no
/// such solution.
std::vector<HarmonicResult> solve_without_inertia(const Scene& scene, const Preparation& prepared,
                                                  const Inertia& inertia, const Watcher& watcher, Backend backend,
                                                  Plan& plan) {
  const std::vector<double>& frequencies = scene.cyclic().frequencies;
  std::string why;
  if (prepared.loose_particles > 0)
    why = fmt::format("{} particles have no path of contacts to both walls", prepared.loose_particles);
  if (const auto without = first_without_stiffness(scene.laws))
    why = fmt::format("law {} of {} has no complex stiffness", without->law, to_string(without->pair));
  if (why.empty()) {
    try {
      const double residual = std::clamp(1e-5 * *scene.solver.tolerance, HarmonicOptions{}.tolerance, 1e-8);
      Harmonic harmonic(prepared.specimen, prepared.network, scene.laws, inertia,
                        harmonic_options(scene, backend, watcher.stop, residual), geometric_mean(frequencies));
      std::vector<HarmonicLoad> loads;
      for (const double f : frequencies) loads.push_back({f, 0, 0});
      return harmonic.solve(loads);
    } catch (const InterruptedError&) { throw; } catch (const RunError& error) {
      why = error.what();
    }
  }
  plan.decisions.push_back("there is no harmonic solution to start from or to compare with: " + why);
  return {};
}

}  // namespace

Plan make_increment_plan(const Scene& asked, const Preparation& prepared, const Inertia& inertia,
                         const Watcher& watcher, Backend backend, PhaseSeconds& phases) {
  if (asked.solver.geometry == Geometry::updated) {
    throw InputError(asked.file.string(), 0, "geometry with method \"quasi_static\"", "\"updated\"",
                     "\"fixed\", or method = \"explicit\"");
  }
  const Scene scene = with_increment_settings(asked);
  Plan plan;
  plan.form = can_crack(facts_of(scene.laws)) ? ContactForm::points : ContactForm::condensed;
  plan.geometry = Geometry::fixed;
  plan.critical.particle = -1;
  plan.samples_per_cycle = increments_per_cycle(*scene.solver.tolerance);
  if (const std::string unused = keys_of_steps(scene.solver); !unused.empty()) {
    plan.decisions.push_back(
        fmt::format("not used: {} in [solver], because increments have no inertia and no time step", unused));
  }
  plan.decisions.push_back(fmt::format(
      "{} samples per cycle, each at the end of an increment, so that the increments change |E*| and phi by less than "
      "{:g}; samples_per_cycle of the scene is not used",
      plan.samples_per_cycle, *scene.solver.tolerance));
  const InPhase in(phases, &PhaseSeconds::harmonic);
  std::vector<HarmonicResult> known = solve_without_inertia(scene, prepared, inertia, watcher, backend, plan);
  const Start start = known.empty() ? Start::rest : cyclic_start(scene, Geometry::fixed);
  plan.decisions.push_back(start == Start::steady
                               ? "the run starts in the steady state of the harmonic solution without inertia, so that "
                                 "the first cycle is already periodic"
                               : "the run starts from rest");
  const std::vector<double>& frequencies = scene.cyclic().frequencies;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    FrequencyPlan f;
    f.start = start;
    const CycleCount count = count_cycles(scene, start);
    f.cycles = count.cycles, f.fit_cycles = count.fitted;
    if (std::int64_t{f.cycles} * plan.samples_per_cycle > most_samples) {
      throw InputError(scene.file.string(), 0, "cycles in [loading] with method \"quasi_static\"",
                       fmt::format("{} of {} increments each", f.cycles, plan.samples_per_cycle),
                       fmt::format("at most {} increments", most_samples));
    }
    f.loading.amplitude = scene.cyclic().strain_amplitude * gauge_length(prepared.specimen);
    f.loading.frequency = frequencies[i];
    f.loading.steps_per_period = units_per_sample * plan.samples_per_cycle;
    f.loading.ramp_steps = std::llround(count.ramp * static_cast<double>(f.loading.steps_per_period));
    if (!known.empty()) f.known = known[i].top;
    if (start == Start::steady) f.motion = std::move(known[i].motion);
    plan.frequencies.push_back(std::move(f));
  }
  return plan;
}

std::unique_ptr<QuasiStaticStepper> make_cycle_increments(const Scene& scene, const Preparation& prepared,
                                                          const Plan& plan, const FrequencyPlan& frequency,
                                                          const std::vector<StateArray>& state, Backend backend) {
  quasi_static::CourseOptions options;
  options.solver.backend = backend;
  if (backend == Backend::cuda) options.solver.devices = scene.solver.devices;
  options.height = gauge_length(prepared.specimen);
  options.area = section_area(prepared.specimen);
  const double tolerance = scene.solver.tolerance.value_or(usual_increment_tolerance);
  // with linear laws the number of samples alone makes the increments accurate enough
  options.tolerance = first_without_stiffness(scene.laws) ? tolerance : 1;
  const std::int64_t samples = std::int64_t{frequency.cycles} * plan.samples_per_cycle;
  const std::int64_t stride = frequency.loading.steps_per_period / plan.samples_per_cycle;
  for (std::int64_t k = 1; k <= samples; ++k) options.stops.push_back(k * stride);
  options.first = frequency.start == Start::steady ? stride : stride / first_fraction;
  if (!options.solver.solves_directly(prepared.specimen.size()))
    options.solver.residual = std::min(1e-6, 1e-3 * tolerance);
  auto out = std::make_unique<QuasiStaticStepper>(prepared.specimen, prepared.network, scene.laws,
                                                  moving_top(frequency.loading), std::move(options));
  if (!state.empty()) {
    out->set_state(state);
  } else if (frequency.start == Start::steady) {
    drives::Cyclic fine = frequency.loading;
    fine.steps_per_period = steps_of_start;
    out->start(steady_start(prepared.network, scene.laws, frequency.motion, fine));
  }
  return out;
}

}  // namespace macadam
