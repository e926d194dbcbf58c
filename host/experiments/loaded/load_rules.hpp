// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_rules.hpp  Rules for stepping a relaxation, a creep or a constant rate. The plan and the forecast both
/// use them.
#pragma once

#include "host/experiments/loaded/load_test.hpp"

namespace macadam {

/// Returns the period of the slowest wave [s] of a specimen that is held at both ends, or loaded by a stress at one
/// end. `modulus`: instantaneous [Pa]; `density`: with the density scaling [kg/m³].
double slowest_period(const LoadTest& test, double height, double modulus, double density);

/// Returns the ramp of the load [s]: the given one; the whole test for a constant rate; `slowest` for an instantaneous
/// load.
double ramp_of(const LoadTest& test, double slowest);

/// Damping of a stepped test.
struct LoadDamping {
  Damping kind = Damping::none;
  double value = 0;       ///< χ, or β [1/s]
  bool chosen = false;    ///< chosen by these rules, and viscous then
  bool critical = false;  ///< critical for the slowest wave, because the first points come before waves have died out
  double pause = 0;       ///< the shortest time from a change of the load's rate to a point [s]
};

/// Returns the damping that the scene gives; otherwise the weakest viscous damping that the points need.
LoadDamping damping_of(const LoadTest& test, const SolverSpec& solver, double ramp, double slowest);

/// Returns the longest step that the rules allow [s], with a whole number of steps in a ramp. `critical`: critical step
/// at true mass [s].
/// \throws RunError for too many steps, as require_possible() does.
double load_step(const LoadTest& test, const SolverSpec& solver, double critical, double density_scaling, double ramp,
                 const LoadDamping& damping);

}  // namespace macadam
