// SPDX-License-Identifier: GPL-3.0-or-later
// run.cpp  The main job: steps a prepared scene through its frequencies and writes what it measures as it goes.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "host/results/files.hpp"
#include "host/simulation/summary.hpp"
#include "macadam/error.hpp"
#include "macadam/simulation.hpp"
#include "macadam/stepper.hpp"

namespace macadam {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double scaling_of(const SolverSpec& solver, std::size_t frequency) {
  return solver.density_scaling[solver.density_scaling.size() == 1 ? 0 : frequency];
}

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
      throw DivergenceError(
          fmt::format(
              "the time stepping diverged: particle {} moves more than its radius in a step, or not finitely, at "
              "t = {:.6g} s ({} Hz, step {}, dt = {:.6g} s); use a smaller time_step or safety",
              particle, now.time, loading.frequency, now.step, loading.dt()),
          particle, now.time);
    }
    samples.push_back({loading.frequency, now.time, now.wall_displacement / height, stress});
    writer.add(samples.back());
    stepped(k * stride);
  }
  const int fit_cycles = scene.loading.fit_cycles > 0 ? scene.loading.fit_cycles : scene.loading.cycles >= 4 ? 2 : 1;
  return evaluate_cyclic(samples, loading.frequency, fit_cycles);
}

}  // namespace

RunResult run(const Scene& scene, const std::filesystem::path& out, const Progress& progress,
              const std::function<void(const Preparation&)>& on_prepared) {
  if (scene.solver.method == SolverMethod::harmonic) {
    throw InputError(scene.file.string(), 0, "solver.method", "\"harmonic\"",
                     "\"explicit\": this version has no harmonic solver");
  }
  const Backend backend = select_backend(scene.solver.backend);  // before any work: cuda may not be there
  make_result_folder(out);
  const Preparation prepared = prepare(scene, progress);
  write_preparation(scene, prepared, out);
  if (on_prepared) on_prepared(prepared);

  RunResult result;
  result.backend = backend;
  const Inertia inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  StepperOptions options;
  options.form = scene.solver.form;
  options.geometry = scene.solver.geometry;
  options.precision = scene.solver.precision;
  options.damping_kind = scene.solver.damping_kind;
  options.damping = scene.solver.damping;
  options.threads = scene.solver.threads;
  const CriticalStep unscaled = critical_step(prepared.network, scene.laws, inertia, options);
  result.critical_particle = unscaled.particle;

  ResponseWriter writer(out / "response.csv");
  const auto& frequencies = scene.loading.frequencies;
  auto save = [&](const std::string& status) {
    write_whole(out / "summary.json", summary_json(scene, prepared, result, status));
  };
  try {
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const auto start = Clock::now();
      FrequencyResult f;
      f.frequency_hz = frequencies[i];
      f.density_scaling = options.density_scaling = scaling_of(scene.solver, i);
      const double largest =
          scene.solver.time_step.value_or(scene.solver.safety * unscaled.dt * std::sqrt(f.density_scaling));
      options.loading = make_loading(scene, prepared.specimen, f.frequency_hz, largest);
      f.dt_s = options.dt = options.loading->dt();
      const auto stepper = make_stepper(backend, prepared.specimen, prepared.network, scene.laws, inertia, options);
      result.stepper = stepper->description();
      result.bytes = stepper->bytes();
      save("running");
      f.steps = options.loading->steps_per_period * scene.loading.cycles;
      f.cyclic = run_cyclic(scene, prepared.specimen, *stepper, *options.loading, writer, [&](std::int64_t done) {
        const double spent = seconds_since(start);
        if (progress && done > 0) {
          progress(fmt::format("{} Hz ({} of {}), cycle {:.2f} of {}, {:.0f} steps/s", f.frequency_hz, i + 1,
                               frequencies.size(),
                               static_cast<double>(done) / static_cast<double>(options.loading->steps_per_period),
                               scene.loading.cycles, static_cast<double>(done) / spent),
                   static_cast<double>(done) / static_cast<double>(f.steps));
        }
      });
      f.seconds = seconds_since(start);
      result.frequencies.push_back(f);
    }
  } catch (const std::exception& error) {
    save(std::string("failed: ") + error.what());
    throw;
  }
  save("done");
  return result;
}

}  // namespace macadam
