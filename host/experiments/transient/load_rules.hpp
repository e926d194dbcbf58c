// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_rules.hpp  Computes ramp, damping and time step of a stepped relaxation, creep or constant-rate test.
/// Both the plan of a run and the forecast of its duration use these rules.
#pragma once

#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

/// Returns the period of the slowest wave [s] of a specimen that is held at both ends, or loaded by a stress at one
/// end. `modulus`: instantaneous modulus [Pa]; `density`: scaled density [kg/m³].
double slowest_period(const TransientExperiment& test, double height, double modulus, double density);

/// Returns the time in which the load grows [s]: the duration of the test for a constant rate, otherwise the ramp of
/// the scene. If that ramp is 0 (instantaneous load), returns `slowest`, the period of the slowest wave.
double ramp_of(const TransientExperiment& test, double slowest);

/// Damping of a stepped test.
struct LoadDamping {
  Damping kind = Damping::none;
  double value = 0;       ///< χ, or β [1/s]
  bool chosen = false;    ///< whether these rules chose viscous damping; otherwise the scene or cracks decided
  bool critical = false;  ///< whether it is the critical damping of the slowest wave; weaker damping would leave waves
                          ///< at the first points
  double pause = 0;       ///< shortest time from a change of the load's rate to the next point of the result [s]
};

/// Returns whether the test begins with the velocities of its strain rate, so that its start causes no waves. Strength
/// tests of contacts that crack begin in this way, because waves would change the strength.
bool starts_in_motion(const TransientExperiment& test, const FactsTable& laws);

/// Returns the damping of the scene. If it gives none, returns the weakest viscous damping with which waves have died
/// out at the points of the result. A test that starts in motion has no damping in tension, so that the balance of
/// energies can be checked, and a weak local damping in compression, where sliding faces excite vibrations.
LoadDamping damping_of(const TransientExperiment& test, const SolverSpec& solver, const FactsTable& laws, double ramp,
                       double slowest);

/// Returns the longest time step that the rules allow [s]; a ramp has a whole number of steps. `critical`: critical
/// time step without density scaling [s]. \throws RunError for too many steps, as require_possible() does.
double load_step(const TransientExperiment& test, const SolverSpec& solver, double critical, double density_scaling,
                 double ramp, const LoadDamping& damping);

}  // namespace macadam
