// SPDX-License-Identifier: GPL-3.0-or-later
/// \file frequency.hpp  What is found at one frequency: by stepping, or as the steady state of the frequency domain.
#pragma once

#include <optional>
#include <string>

#include "macadam/linear_method.hpp"
#include "macadam/results.hpp"
#include "macadam/sensitivity.hpp"

namespace macadam {

/// An error of |E*| (relative) and of φ [rad], with signs.
struct ErrorEstimate {
  double e_star = 0, phase_rad = 0;
};

namespace experiments {

/// Whichever way it was found.
struct Frequency {
  double frequency_hz = 0;
  std::optional<double> temperature_c;  ///< where the scene has one
  Stiffness stiffness;                  ///< the result, from the reaction of the top wall
  bool confined = false;                ///< the sides were held: it is a confined modulus
  double density_scaling = 1;           ///< of the inertia that is in the result
  double seconds = 0;                   ///< wall time of the solution
  std::string fault;                    ///< what of it cannot be right; empty where nothing is known to be wrong
};

/// The steady state.
struct HarmonicFrequency : Frequency {
  double residual = 0;  ///< ‖f − K·u‖/‖f‖
  ModulusParts parts;   ///< of which |E*| and φ are the sum
  Stiffness bottom;     ///< from the reaction of the bottom wall
  int iterations = 0;
  LinearMethod linear = LinearMethod::iterative;  ///< that found the solution
  double held_force = 0;                          ///< force that holds free rigid motions / reaction
};

}  // namespace experiments
}  // namespace macadam
