// SPDX-License-Identifier: GPL-3.0-or-later
// step_frequencies.cpp  The cyclic test stepped in time, one frequency after another, each from rest.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "host/results/files.hpp"
#include "host/simulation/error_model.hpp"
#include "host/simulation/plan.hpp"
#include "host/simulation/solution.hpp"
#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Runs one frequency; every sample goes to `writer` at once.
/// \throws DivergenceError naming the particle that left the range of sense first.
CyclicResult run_cyclic(const Scene& scene, const Specimen& specimen, Stepper& stepper, const FrequencyPlan& plan,
                        ResponseWriter& writer, const std::function<void(std::int64_t)>& stepped) {
  const loadings::Cyclic& loading = plan.loading;
  const int per_cycle = scene.loading.samples_per_cycle;
  const std::int64_t samples_wanted = static_cast<std::int64_t>(plan.cycles) * per_cycle;
  const std::int64_t stride = loading.steps_per_period / per_cycle;
  const double area = specimen.box.size.x * specimen.box.size.y, height = specimen.box.size.z;
  std::vector<ResponseSample> samples;
  for (std::int64_t k = 0; k <= samples_wanted; ++k) {
    if (k > 0) stepper.advance(stride);
    const Observation now = stepper.observe();
    const double stress = -now.wall_force[5].z / area;  // particles pull a wall that moves away from them
    if (const std::int64_t particle = stepper.first_divergent(); particle >= 0 || !std::isfinite(stress)) {
      const std::string what =
          particle >= 0 ? fmt::format("particle {} moves more than its radius in a step, or not finitely", particle)
                        : "the stress at the top wall is not finite";
      throw DivergenceError(
          fmt::format("the time stepping diverged: {}, at t = {:.6g} s ({} Hz, step {}, dt = {:.6g} s); use a smaller "
                      "time_step or safety",
                      what, now.time, loading.frequency, now.step, loading.dt()),
          particle, now.time);
    }
    samples.push_back({loading.frequency, now.time, now.wall_displacement / height, stress});
    writer.add(samples.back());
    stepped(k * stride);
  }
  return evaluate_cyclic(samples, loading.frequency, plan.fit_cycles);
}

/// What all frequencies have in common.
StepperOptions common_options(const Plan& plan, const SolverSpec& solver) {
  StepperOptions options;
  options.form = plan.form;
  options.geometry = plan.geometry;
  options.precision = plan.precision;
  options.damping_kind = solver.damping_kind;
  options.damping = solver.damping;
  options.threads = solver.threads;
  return options;
}

}  // namespace

double density_scaling_of(const SolverSpec& solver, std::size_t frequency) {
  if (!solver.density_scaling) return 1;
  return (*solver.density_scaling)[solver.density_scaling->size() == 1 ? 0 : frequency];
}

void step_frequencies(const Scene& scene, const Preparation& prepared, const std::filesystem::path& response,
                      const Watcher& watcher, const Saving& save, RunResult& result) {
  const auto planning = Clock::now();
  const Inertia inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  const Plan plan = make_plan(scene, prepared, inertia, watcher.progress);
  result.decisions = plan.decisions;
  result.form = plan.form;
  result.geometry = plan.geometry;
  result.precision = plan.precision;
  result.critical_particle = plan.critical.particle;
  result.critical_dt_s = plan.critical.dt;
  result.seconds_planning = seconds_since(planning);
  if (watcher.planned) watcher.planned(plan.decisions);
  StepperOptions options = common_options(plan, scene.solver);
  ResponseWriter writer(response);
  for (std::size_t i = 0; i < plan.frequencies.size(); ++i) {
    const auto start = Clock::now();
    const FrequencyPlan& p = plan.frequencies[i];
    FrequencyResult f;
    f.frequency_hz = p.loading.frequency;
    f.density_scaling = options.density_scaling = p.density_scaling;
    options.loading = p.loading;
    f.dt_s = options.dt = p.loading.dt();
    f.cycles = p.cycles;
    f.start = p.start;
    f.steps = p.loading.steps_per_period * p.cycles;
    std::unique_ptr<Stepper> stepper;
    {
      StartState state;
      if (p.start == Start::steady) {
        state = steady_start(prepared.network, scene.laws, p.motion, p.loading);
        options.start = &state;
      }
      stepper = make_stepper(result.backend, prepared.specimen, prepared.network, scene.laws, inertia, options);
      options.start = nullptr;
    }
    result.solver = stepper->description();
    result.bytes = stepper->bytes();
    save("running");
    const auto stepped = [&](std::int64_t done) {
      if (!watcher.progress || done == 0) return;
      const auto steps = static_cast<double>(done);
      watcher.progress(fmt::format("{} Hz ({} of {}), cycle {:.2f} of {}, {:.0f} steps/s", f.frequency_hz, i + 1,
                                   plan.frequencies.size(), steps / static_cast<double>(p.loading.steps_per_period),
                                   p.cycles, steps / seconds_since(start)),
                       steps / static_cast<double>(f.steps));
    };
    f.cyclic = run_cyclic(scene, prepared.specimen, *stepper, p, writer, stepped);
    f.stiffness = f.cyclic->fit;
    f.residual = f.cyclic->fit_rms;
    f.predicted = p.predicted;
    if (p.known) f.achieved = inertia_error(f.stiffness, *p.known);
    f.seconds = seconds_since(start);
    result.frequencies.push_back(f);
  }
}

}  // namespace macadam
