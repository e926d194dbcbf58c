// SPDX-License-Identifier: GPL-3.0-or-later
// step_rules.cpp  Chooses geometry, start, cycles, density scaling and time step of a cyclic test.
#include "host/experiments/cyclic/step_rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/run/error_model.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/run/harmonic_options.hpp"

namespace macadam {

Geometry cyclic_geometry(const Scene& scene) {
  const SolverSpec& solver = scene.solver;
  if (solver.geometry) return *solver.geometry;
  const bool allowed =
      solver.tolerance && fixed_geometry_error(scene.cyclic().strain_amplitude) <= geometry_part * *solver.tolerance;
  return allowed ? Geometry::fixed : Geometry::updated;
}

double nonlinear_effect(const Scene& scene, Geometry geometry) {
  return geometry == Geometry::fixed ? 0 : fixed_geometry_error(scene.cyclic().strain_amplitude);
}

bool is_strain_large(const Scene& scene, Geometry geometry) {
  const std::optional<double>& tolerance = scene.solver.tolerance;
  return nonlinear_effect(scene, geometry) > (tolerance ? 0.1 * *tolerance : 1e-4);
}

Start asked_start(const Scene& scene) {
  const experiments::Cyclic& test = scene.cyclic();
  const bool chosen = scene.solver.tolerance && test.ramp_cycles.value_or(0) == 0;
  return test.start.value_or(chosen ? Start::steady : Start::rest);
}

Start cyclic_start(const Scene& scene, Geometry geometry) {
  const bool possible = scene.solver.damping_kind != Damping::local && !is_strain_large(scene, geometry) &&
                        !first_without_stiffness(scene.laws);
  return possible ? asked_start(scene) : Start::rest;
}

bool plans_with_solutions(const Scene& scene) { return scene.solver.tolerance || asked_start(scene) == Start::steady; }

double usual_ramp(const Scene& scene) { return plans_with_solutions(scene) ? 1 : 0; }

CycleCount count_cycles(const Scene& scene, Start start) {
  const experiments::Cyclic& test = scene.cyclic();
  const bool steady = start == Start::steady;
  const std::optional<double>& tolerance = scene.solver.tolerance;
  CycleCount out;
  out.ramp = steady ? 0 : test.ramp_cycles.value_or(usual_ramp(scene));
  constexpr int without_tolerance = 5;
  out.cycles = test.cycles.value_or(steady ? 1 : tolerance ? cycles_from_rest(*tolerance) : without_tolerance);
  if (!test.cycles) {
    while (out.cycles - test.fitted(out.cycles) < out.ramp) ++out.cycles;
  }
  out.fitted = std::min(out.cycles, test.fitted(out.cycles));
  if (!test.ramp_cycles) out.ramp = std::min(out.ramp, static_cast<double>(out.cycles - out.fitted));
  return out;
}

std::optional<double> given_scaling(const Scene& scene, std::size_t frequency, double critical) {
  const SolverSpec& solver = scene.solver;
  if (solver.density_scaling || !solver.tolerance) return density_scaling_of(solver, frequency);
  if (!solver.time_step) return {};
  SolverSpec computed;  // settings without the given time step, to compute the step that would be chosen
  computed.tolerance = solver.tolerance, computed.safety = solver.safety;
  const double safe = longest_cyclic_step(computed, critical, 1);
  return std::max(1.0, std::pow(*solver.time_step / safe, 2));  // the least scaling with which the given step is stable
}

// With n increments per period the rule gives the response at a frequency that is higher by the part (2π/n)²/12. The
// relative change of |E*|, and the change of φ [rad], are at most the relative change of the frequency.
int increments_per_cycle(double tolerance) {
  constexpr int fewest = 40;  // the parabola through a peak and the fit of the second harmonic need several
  const double n = 2 * std::numbers::pi / std::sqrt(12 * 0.5 * tolerance);
  return std::max(fewest, 4 * static_cast<int>(std::ceil(n / 4)));
}

Scene with_increment_settings(Scene scene) {
  scene.solver.tolerance = scene.solver.tolerance.value_or(usual_increment_tolerance);
  scene.solver.geometry = Geometry::fixed;
  scene.solver.damping_kind = Damping::none;
  return scene;
}

double samples_by_increments(const Scene& scene) {
  const Scene asked = with_increment_settings(scene);
  const CycleCount count = count_cycles(asked, cyclic_start(asked, Geometry::fixed));
  return static_cast<double>(count.cycles) * increments_per_cycle(*asked.solver.tolerance);
}

double longest_cyclic_step(const SolverSpec& solver, double critical, double density_scaling) {
  if (solver.time_step) return *solver.time_step;
  const double safety = solver.safety.value_or(solver.tolerance ? 0.95 : 0.8);
  const double step = safety * critical * std::sqrt(density_scaling);
  const bool viscous = solver.damping_kind == Damping::viscous && solver.damping > 0;
  return viscous ? std::min(step, 1 / solver.damping) : step;  // so that several steps resolve the decay by damping
}

double steps_per_period(double frequency, double step, int samples) {
  return std::max(1.0, std::ceil(1 / (frequency * step * samples))) * samples;
}

}  // namespace macadam
