// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_rules.hpp  Defines those rules for stepping a cyclic test that need only the scene. The plan and the
/// forecast both use them.
#pragma once

#include <cstdint>
#include <optional>

#include "macadam/scene.hpp"

namespace macadam {

/// Parts of the tolerance. Inertia takes most of it, because a solution predicts its error; without a solution its
/// error is an estimate. The remainder is for rounding (choose_precision()), geometry, start and time step.
inline constexpr double inertia_part = 0.9, estimate_part = 0.5, geometry_part = 0.02;
/// The density scaling is computed from the derivative of E* for this part of the error allowed to inertia, so that the
/// exact solution stays within the allowed error.
inline constexpr double aimed_part = 0.97;

/// Returns the geometry of the scene. If it gives none, returns fixed if the tolerance allows it, otherwise updated.
Geometry cyclic_geometry(const Scene& scene);

/// Returns the relative effect of the strain on |E*| that a harmonic solution does not contain.
double nonlinear_effect(const Scene& scene, Geometry geometry);
/// Returns whether that effect is too large for a steady start.
bool is_strain_large(const Scene& scene, Geometry geometry);

/// Returns the start of the scene. If it gives none, returns the steady start if there is a tolerance and no ramp,
/// otherwise the start from rest.
Start asked_start(const Scene& scene);
/// Returns the start, as far as the scene alone decides it. It is also from rest if damping, strain or a law
/// excludes a periodic solution.
Start cyclic_start(const Scene& scene, Geometry geometry);

/// Returns whether the plan of a stepped test solves its frequencies without time steps: to predict errors, if there is
/// a tolerance, and for a steady start.
bool plans_with_solutions(const Scene& scene);

/// Cycles of one frequency: all, those that are fitted, and those in which the amplitude grows.
struct CycleCount {
  int cycles = 0, fitted = 0;
  double ramp = 0;
};
CycleCount count_cycles(const Scene& scene, Start start);
/// Returns the number of cycles of the ramp from rest if the scene gives none.
double usual_ramp(const Scene& scene);

/// Returns the density scaling of a frequency if it does not follow from the error of inertia; otherwise nothing.
/// `critical`: the critical step at true mass [s].
std::optional<double> given_scaling(const Scene& scene, std::size_t frequency, double critical);

/// Returns the longest step that the rules allow [s].
double longest_cyclic_step(const SolverSpec& solver, double critical, double density_scaling);

/// Returns the number of steps per period that makes them no longer than `step`: a whole number of samples, each of a
/// whole number of steps. It is a floating-point number, because it may be too large for a run.
double steps_per_period(double frequency, double step, int samples);

}  // namespace macadam
