// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_rules.hpp  Defines those rules for stepping a cyclic test that need only the scene. Both the plan of
/// a run and the forecast of its duration use these rules.
#pragma once

#include <cstdint>
#include <optional>

#include "macadam/scene.hpp"

namespace macadam {

/// Fractions of the tolerance that single errors may reach. The error from scaled inertia may reach `inertia_part` if a
/// harmonic solution predicts it, and `estimate_part` if it is only estimated. The error from a fixed geometry may
/// reach `geometry_part`. The remainder is for the errors from rounding (choose_precision()), start and time step.
inline constexpr double inertia_part = 0.9, estimate_part = 0.5, geometry_part = 0.02;
/// The density scaling is chosen so that its predicted error is this fraction of the allowed error. The prediction uses
/// only the derivative of E*; a fraction below 1 leaves room for the difference between predicted and exact error.
inline constexpr double aimed_part = 0.97;

/// Returns the geometry of the scene. If it gives none, returns fixed if the tolerance allows it, otherwise updated.
Geometry cyclic_geometry(const Scene& scene);

/// Returns the relative effect of the strain on |E*| that a harmonic solution does not contain.
double nonlinear_effect(const Scene& scene, Geometry geometry);
/// Returns whether nonlinear_effect() is too large for a steady start.
bool is_strain_large(const Scene& scene, Geometry geometry);

/// Returns the start of the scene. If it gives none, returns the steady start if there is a tolerance and no ramp,
/// otherwise the start from rest.
Start asked_start(const Scene& scene);
/// Returns the start that follows from the scene alone: asked_start() or, if damping, strain or a law excludes a
/// periodic solution, the start from rest.
Start cyclic_start(const Scene& scene, Geometry geometry);

/// Returns whether the plan of a stepped test also solves its frequencies in the frequency domain. The plan needs these
/// solutions to predict errors, if there is a tolerance, and for a steady start.
bool plans_with_solutions(const Scene& scene);

/// Cycles of one frequency: all, those that are fitted, and those in which the amplitude grows.
struct CycleCount {
  int cycles = 0, fitted = 0;
  double ramp = 0;
};
CycleCount count_cycles(const Scene& scene, Start start);
/// Returns the number of cycles of the ramp from rest if the scene gives none.
double usual_ramp(const Scene& scene);

/// Returns the density scaling of a frequency if `density_scaling` or `time_step` of the scene determines it, or 1 in a
/// scene without a tolerance. Returns nothing if the scaling must be chosen from the error of inertia. `critical`: the
/// critical step at true mass [s].
std::optional<double> given_scaling(const Scene& scene, std::size_t frequency, double critical);

/// Tolerance of the increments of method "quasi_static" if the scene gives none: of |E*| (relative) and φ [rad], and of
/// the stress of an increment.
inline constexpr double usual_increment_tolerance = 1e-3;

/// Returns the number of increments, and of samples, per cycle with which the trapezoidal rule has at most half of the
/// error `tolerance`.
int increments_per_cycle(double tolerance);

/// Returns the scene with the settings that increments use: a tolerance, fixed geometry and no damping.
Scene with_increment_settings(Scene scene);

/// Returns the number of samples of one frequency by increments, as far as the scene alone determines it.
double samples_by_increments(const Scene& scene);

/// Returns the longest step that the rules allow [s].
double longest_cyclic_step(const SolverSpec& solver, double critical, double density_scaling);

/// Returns the smallest number of steps per period with which no step is longer than `step`. This number is a multiple
/// of `samples`, so that every sample has a whole number of steps. Its type is double, because the number may be too
/// large for a run.
double steps_per_period(double frequency, double step, int samples);

}  // namespace macadam
