// SPDX-License-Identifier: GPL-3.0-or-later
/// \file energies.hpp  Defines the energies of a specimen during a test, counted from its beginning.
#pragma once

namespace macadam::experiments {

/// Energies at one time since the beginning of a test [J]. A number that was not computed is NaN.
struct Energies {
  double work_j = 0;      ///< work of the walls on the particles
  double elastic_j = 0;   ///< stored in the springs of the contact laws
  double viscous_j = 0;   ///< dissipated in the dashpots of the contact laws
  double crack_j = 0;     ///< dissipated by damage, and stored in open cracks
  double friction_j = 0;  ///< dissipated by friction in cracks
  double kinetic_j = 0;   ///< change of the energy of motion of the particles, density scaling included
  double damping_j = 0;   ///< dissipated by the damping of time steps, or by the drag in sudden drops
  double thermal_j = 0;   ///< work of the contacts' forces against thermal expansion

  /// Returns the work that no other energy accounts for [J]. Without an error it is zero.
  double missing() const {
    return work_j + thermal_j - (elastic_j + viscous_j + crack_j + friction_j + kinetic_j + damping_j);
  }
};

}  // namespace macadam::experiments
