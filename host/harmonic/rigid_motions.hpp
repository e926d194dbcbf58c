// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rigid_motions.hpp  Motions of the whole specimen that no wall resists, and pins that hold them without force.
#pragma once

#include <vector>

#include "host/harmonic/contact_operator.hpp"
#include "macadam/specimen.hpp"
#include "macadam/stepper.hpp"

namespace macadam::harmonic {

/// A scalar spring to ground on one degree of freedom.
struct Pin {
  std::size_t dof;
  double stiffness;
};

/// The free rigid motions (three between frictionless walls: x, y and yaw).
struct FreeMotions {
  /// On as many degrees of freedom, so chosen that they hold nothing else: a load in equilibrium leaves them without
  /// force.
  std::vector<Pin> pins;
  /// [motion][6·particle + component], orthonormal with respect to masses and moments of inertia [1/√kg].
  std::vector<std::vector<double>> motions;
};

/// \throws InputError naming the particles of a cluster that does not touch both walls: nothing says where it is.
FreeMotions find_free_motions(const Specimen& specimen, const ContactNetwork& network, const PairStiffness& stiffness,
                              const Inertia& inertia);

}  // namespace macadam::harmonic
