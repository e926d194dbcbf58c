// SPDX-License-Identifier: GPL-3.0-or-later
/// \file frequency.hpp  Defines the result at one frequency. It is computed by time stepping or as a steady state in
/// the frequency domain.
#pragma once

#include <complex>
#include <optional>
#include <string>

#include "macadam/linear_method.hpp"
#include "macadam/results.hpp"
#include "macadam/sensitivity.hpp"

namespace macadam {

/// Errors of |E*| (relative) and of φ [rad], with signs.
struct ErrorEstimate {
  double e_star = 0, phase_rad = 0;
};

namespace experiments {

/// The members of the result that both methods have.
struct Frequency {
  double frequency_hz = 0;
  std::optional<double> temperature_c;  ///< empty if the scene has none
  Stiffness stiffness;                  ///< from the reaction of the top wall
  bool confined = false;                ///< whether the sides were held; the modulus is then a confined one
  bool shear = false;                   ///< whether `stiffness` is the shear modulus G* of a torsion test
  /// Complex Poisson's ratio (lateral contraction over axial extension); empty if the sides are held or if no cell
  /// touches one of them.
  std::optional<std::complex<double>> poisson_ratio = {};
  double density_scaling = 1;  ///< density scaling of the inertia in this result; 0: no inertia
  double seconds = 0;          ///< wall time of the solution
  std::string fault;           ///< the reason if the result cannot be right; otherwise empty
};

/// Returns the symbol of the modulus for messages and tables.
inline const char* modulus_symbol(const Frequency& f) { return f.shear ? "|G*|" : f.confined ? "|M*|" : "|E*|"; }

/// Deformations of a disc between two strips that press it, per force [m/N].
struct DiscCompliance {
  std::complex<double> horizontal;  ///< increase of the horizontal diameter
  std::complex<double> vertical;    ///< decrease of the middle half of the vertical diameter
  std::complex<double> strips;      ///< approach of the strips
};

/// Deformations of a beam between rollers, per force of the upper rollers together [m/N].
struct BeamCompliance {
  std::complex<double> midspan;  ///< deflection at midspan relative to the supports, at half of the height
  std::complex<double> rollers;  ///< approach of the upper and the lower rollers
};

/// Result of a solution in the frequency domain.
struct HarmonicFrequency : Frequency {
  double residual = 0;  ///< ‖f − K·u‖/‖f‖
  /// Parts of E*, or of G* in a torsion test, which is their sum; zero for a disc and for a beam between rollers.
  ModulusParts parts;
  Stiffness bottom;  ///< from the reaction of the bottom wall
  int iterations = 0;
  LinearMethod linear = LinearMethod::iterative;  ///< the method that found the solution
  /// Force of the springs that hold free rigid motions, divided by the wall's reaction; nearly 0 in a correct solution.
  double held_force = 0;
  std::optional<DiscCompliance> disc = {};  ///< of an indirect tension test
  std::optional<BeamCompliance> beam = {};  ///< of a bending test
  /// Torque over the turn of the top platen [N·m/rad], of a torsion test.
  std::optional<std::complex<double>> torque_per_turn = {};
};

}  // namespace experiments
}  // namespace macadam
