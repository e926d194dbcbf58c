// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_rules.hpp  Rules by which a cyclic test is stepped, as far as they follow from the scene: the plan and
/// the forecast both use them.
#pragma once

#include <cstdint>
#include <optional>

#include "macadam/scene.hpp"

namespace macadam {

/// Parts of the tolerance. Inertia is predicted by a solution and so takes most of it; without a solution it is an
/// estimate. The remainder is for rounding (choose_precision()), geometry, start and time step.
inline constexpr double inertia_part = 0.9, estimate_part = 0.5, geometry_part = 0.02;
/// Part of what inertia may cost that the derivative of E* is allowed, so that the solution itself stays below.
inline constexpr double aimed_part = 0.97;

/// The geometry that the scene gives; else the initial one, where the tolerance allows it.
Geometry cyclic_geometry(const Scene& scene);

/// Relative effect of the strain on |E*| that a harmonic solution does not contain.
double nonlinear_effect(const Scene& scene, Geometry geometry);
/// Whether that effect is too large for a steady start.
bool is_strain_large(const Scene& scene, Geometry geometry);

/// The start that the scene gives; else the steady one, where the program chooses and no ramp is given.
Start asked_start(const Scene& scene);
/// The start, as far as the scene tells: from rest too where damping, strain or a law leave no periodic solution.
Start cyclic_start(const Scene& scene, Geometry geometry);

/// Cycles of one frequency: all, those that are fitted, and those in which the amplitude grows.
struct CycleCount {
  int cycles = 0, fitted = 0;
  double ramp = 0;
};
CycleCount count_cycles(const Scene& scene, Start start);
/// Cycles of the ramp from rest where the scene gives none.
double usual_ramp(const Scene& scene);

/// The density scaling of a frequency where it does not follow from the inertia's error; nothing where it does.
/// `critical`: the critical step at true mass [s].
std::optional<double> given_scaling(const Scene& scene, std::size_t frequency, double critical);

/// The longest step that the rules allow [s].
double longest_cyclic_step(const SolverSpec& solver, double critical, double density_scaling);

/// Steps of a period that are no longer than `step`: a whole number of samples, each of a whole number of steps. As a
/// floating-point number, which may be too large for a run.
double steps_per_period(double frequency, double step, int samples);

}  // namespace macadam
