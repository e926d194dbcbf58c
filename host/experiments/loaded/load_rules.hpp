// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_rules.hpp  Rules by which a relaxation, a creep or a constant rate is stepped: the plan and the forecast
/// both use them.
#pragma once

#include "host/experiments/loaded/load_test.hpp"

namespace macadam {

/// The period of the slowest wave of a specimen that is held at both ends, or loaded at one [s]. `modulus`: at once
/// [Pa]; `density`: with the density scaling [kg/m³].
double slowest_period(const LoadTest& test, double height, double modulus, double density);

/// The ramp of the load [s]: as given; the whole test for a constant rate; `slowest` for a load at once.
double ramp_of(const LoadTest& test, double slowest);

/// Damping of a stepped test.
struct LoadDamping {
  Damping kind = Damping::none;
  double value = 0;       ///< χ, or β [1/s]
  bool chosen = false;    ///< by these rules: viscous
  bool critical = false;  ///< for the slowest wave: the first points come before waves have died out
  double pause = 0;       ///< the shortest time from a change of the load's rate to a point [s]
};

/// The damping that the scene gives; else the least viscous damping that the points need.
LoadDamping damping_of(const LoadTest& test, const SolverSpec& solver, double ramp, double slowest);

/// The longest step that the rules allow [s], with a whole number of steps in a ramp. `critical`: at true mass [s].
/// \throws RunError for more steps than anybody waits for.
double load_step(const LoadTest& test, const SolverSpec& solver, double critical, double density_scaling, double ramp,
                 const LoadDamping& damping);

}  // namespace macadam
