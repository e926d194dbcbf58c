// SPDX-License-Identifier: GPL-3.0-or-later
/// \file increments.hpp  Defines the report of a test by increments without inertia.
#pragma once

#include <cstdint>
#include <optional>

namespace macadam::experiments {

/// The largest stress of a test in the direction of its load; it may lie between two points of the result.
struct Peak {
  double time_s = 0, strain = 0, stress_pa = 0;
};

/// The increments of a test by method "quasi_static".
struct Increments {
  /// Numbers of accepted increments, of increments that were repeated with a shorter length, and of linear systems.
  std::int64_t increments = 0, rejected = 0, systems = 0;
  double error = 0;  ///< largest estimated error, relative to the largest stress (creep: strain)
  /// Largest force out of balance at the end of an increment, relative to the size of the forces. With the iterative
  /// solver it may be up to ten times QuasiStaticOptions::residual, because a smaller one may not be found near a loss
  /// of stability.
  double residual = 0;
  double imbalance = 0;  ///< error of the balance of energies (energy_error)
  /// Difference between the crack energy computed from the states of the cracks and the work of their stresses, divided
  /// by the sum of all energies.
  double increment_error = 0;
  /// Largest number of particles without stiffness, and number of increments controlled by the opening of cracks.
  std::int64_t loose = 0, by_opening = 0;
  /// The last equilibrium, if the specimen then broke suddenly while its temperature changed; empty otherwise.
  std::optional<Peak> sudden_break = {};
  double temperature_at_break_c = 0;  ///< of `sudden_break` [°C]
  std::optional<Peak> unstable = {};  ///< the state after which the test was controlled by opening
  /// The state before the first sudden drop of the stress, number of drops, and the energy lost in them [J].
  /// @{
  std::optional<Peak> first_drop = {};
  std::int64_t drops = 0;
  double drop_energy_j = 0;
  /// @}
};

}  // namespace macadam::experiments
