// SPDX-License-Identifier: GPL-3.0-or-later
// solve_frequencies.cpp  Method "harmonic": the steady state of every frequency; the factors of one serve all.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "host/simulation/plan.hpp"
#include "host/simulation/solution.hpp"
#include "macadam/harmonic.hpp"

namespace macadam {
namespace {

/// What the scene gives that only a stepped run takes.
std::string unused_settings(const Scene& scene) {
  const SolverSpec& s = scene.solver;
  const LoadingSpec& l = scene.loading;
  std::string out;
  for (const auto& [given, name] : {std::pair{s.tolerance.has_value(), "tolerance"},
                                    {s.density_scaling && !s.inertia, "density_scaling"},
                                    {s.safety.has_value(), "safety"},
                                    {s.time_step.has_value(), "time_step"},
                                    {s.form.has_value(), "form"},
                                    {s.geometry.has_value(), "geometry"},
                                    {s.precision.has_value(), "precision"},
                                    {l.start.has_value(), "start"},
                                    {l.cycles.has_value(), "cycles"},
                                    {l.ramp_cycles.has_value(), "ramp_cycles"}}) {
    if (given) out += (out.empty() ? "" : ", ") + std::string(name);
  }
  return out;
}

}  // namespace

void solve_frequencies(const Scene& scene, const Preparation& prepared, const Progress& progress, const Saving& save,
                       RunResult& result) {
  const Inertia inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  const auto& frequencies = scene.loading.frequencies;
  const SolverSpec& solver = scene.solver;
  const double viscous = solver.inertia && solver.damping_kind == Damping::viscous ? solver.damping : 0;
  result.solver = solver.inertia ? "harmonic, with inertia" : "harmonic, without inertia";
  if (viscous > 0) result.solver += " and viscous damping";
  if (solver.damping_kind != Damping::none && viscous == 0) {
    result.solver += fmt::format("; {} damping has no part in it", to_string(solver.damping_kind));
  }
  if (const std::string unused = unused_settings(scene); !unused.empty()) { result.solver += "; no use for " + unused; }
  save("running");
  if (progress) progress("harmonic: factoring", 0);
  const auto start = std::chrono::steady_clock::now();
  Harmonic harmonic(prepared.specimen, prepared.network, scene.laws, inertia, {}, geometric_mean(frequencies));
  result.seconds_factoring = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    if (progress) {
      progress(fmt::format("harmonic: {} Hz ({} of {})", frequencies[i], i + 1, frequencies.size()),
               static_cast<double>(i) / static_cast<double>(frequencies.size()));
    }
    FrequencyResult f;
    f.density_scaling = scene.solver.inertia ? density_scaling_of(scene.solver, i) : 0;
    const HarmonicResult solved = harmonic.solve(frequencies[i], f.density_scaling, viscous);
    f.frequency_hz = frequencies[i];
    f.method = SolverMethod::harmonic;
    f.stiffness = solved.top;
    f.bottom = solved.bottom;
    f.residual = solved.residual;
    f.iterations = solved.iterations;
    f.held_force = solved.held_force;
    f.seconds = solved.seconds;
    result.frequencies.push_back(f);
    save("running");
  }
}

}  // namespace macadam
