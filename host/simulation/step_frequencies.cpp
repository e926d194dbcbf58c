// SPDX-License-Identifier: GPL-3.0-or-later
// step_frequencies.cpp  The cyclic test stepped in time, one frequency after another, each from rest.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "host/results/files.hpp"
#include "host/simulation/solution.hpp"
#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The steps of one cyclic test: a whole number of samples a period, a whole number of steps a sample.
loadings::Cyclic make_loading(const Scene& scene, const Specimen& specimen, double frequency, double largest_step) {
  const LoadingSpec& spec = scene.loading;
  const double wanted = 1 / (frequency * largest_step * spec.samples_per_cycle);
  if (!(wanted < 1e12)) {
    throw RunError(fmt::format("the time step of {} s would take {} steps a cycle at {} Hz; raise density_scaling",
                               largest_step, wanted * spec.samples_per_cycle, frequency));
  }
  loadings::Cyclic loading;
  loading.amplitude = spec.strain_amplitude * specimen.box.size.z;
  loading.frequency = frequency;
  loading.steps_per_period = std::max<std::int64_t>(1, std::llround(std::ceil(wanted))) * spec.samples_per_cycle;
  loading.ramp_steps = std::llround(spec.ramp_cycles * static_cast<double>(loading.steps_per_period));
  return loading;
}

/// Runs one frequency; every sample goes to `writer` at once.
/// \throws DivergenceError naming the particle that left the range of sense first.
CyclicResult run_cyclic(const Scene& scene, const Specimen& specimen, Stepper& stepper, const loadings::Cyclic& loading,
                        ResponseWriter& writer, const std::function<void(std::int64_t)>& stepped) {
  const int per_cycle = scene.loading.samples_per_cycle;
  const std::int64_t samples_wanted = static_cast<std::int64_t>(scene.loading.cycles) * per_cycle;
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
  return evaluate_cyclic(samples, loading.frequency, scene.loading.fit_cycles);
}

/// What all frequencies have in common.
StepperOptions common_options(const SolverSpec& solver) {
  StepperOptions options;
  options.form = solver.form;
  options.geometry = solver.geometry;
  options.precision = solver.precision;
  options.damping_kind = solver.damping_kind;
  options.damping = solver.damping;
  options.threads = solver.threads;
  return options;
}

}  // namespace

double density_scaling_of(const SolverSpec& solver, std::size_t frequency) {
  return solver.density_scaling[solver.density_scaling.size() == 1 ? 0 : frequency];
}

void step_frequencies(const Scene& scene, const Preparation& prepared, const std::filesystem::path& response,
                      const Progress& progress, const Saving& save, RunResult& result) {
  const Inertia inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  StepperOptions options = common_options(scene.solver);
  const CriticalStep unscaled = critical_step(prepared.network, scene.laws, inertia, options);
  result.critical_particle = unscaled.particle;
  result.critical_dt_s = unscaled.dt;
  ResponseWriter writer(response);
  const auto& frequencies = scene.loading.frequencies;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const auto start = Clock::now();
    FrequencyResult f;
    f.frequency_hz = frequencies[i];
    f.density_scaling = options.density_scaling = density_scaling_of(scene.solver, i);
    const double critical = scene.solver.safety * unscaled.dt * std::sqrt(f.density_scaling);
    options.loading = make_loading(scene, prepared.specimen, f.frequency_hz, scene.solver.time_step.value_or(critical));
    f.dt_s = options.dt = options.loading->dt();
    f.steps = options.loading->steps_per_period * scene.loading.cycles;
    const auto stepper =
        make_stepper(result.backend, prepared.specimen, prepared.network, scene.laws, inertia, options);
    result.solver = stepper->description();
    result.bytes = stepper->bytes();
    save("running");
    const auto stepped = [&](std::int64_t done) {
      if (!progress || done == 0) return;
      const auto steps = static_cast<double>(done);
      progress(fmt::format("{} Hz ({} of {}), cycle {:.2f} of {}, {:.0f} steps/s", f.frequency_hz, i + 1,
                           frequencies.size(), steps / static_cast<double>(options.loading->steps_per_period),
                           scene.loading.cycles, steps / seconds_since(start)),
               steps / static_cast<double>(f.steps));
    };
    f.cyclic = run_cyclic(scene, prepared.specimen, *stepper, *options.loading, writer, stepped);
    f.stiffness = f.cyclic->fit;
    f.residual = f.cyclic->fit_rms;
    f.seconds = seconds_since(start);
    result.frequencies.push_back(f);
  }
}

}  // namespace macadam
