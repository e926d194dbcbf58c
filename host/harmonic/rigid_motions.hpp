// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rigid_motions.hpp  Motions that nothing resists, and springs to ground that hold them without force.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/harmonic/contact_operator.hpp"
#include "macadam/specimen.hpp"
#include "macadam/stepper.hpp"

namespace macadam::harmonic {

/// A spring to ground on one particle: its load is stiffness·direction·(directionᵀ·motion).
struct Pin {
  std::size_t particle;
  std::array<double, 6> direction;  ///< translations [1], then rotations [m]
  double stiffness;                 ///< [N/m]

  /// Force of the spring under a motion of all particles [6·particles].
  Complex force(const Vector& motion) const {
    Complex along = 0;
    for (std::size_t c = 0; c < 6; ++c) along += direction[c] * motion[6 * particle + c];
    return stiffness * along;
  }
};

/// A motion of some particles; all others are at rest.
struct FreeMotion {
  std::vector<std::int32_t> particles;  ///< ascending
  std::vector<double> motion;           ///< [particle of the list][6], of length 1 with respect to masses [1/√kg]

  /// Takes this motion out of another one, [6·particles of the specimen].
  void remove_from(Vector& other, const Inertia& inertia) const;
};

/// The motions of zero stiffness. Between frictionless walls a specimen has three: x, y, and the turn about z. Parts of
/// it that only flat contacts without shear stiffness join, as the spheres of a vertical column with alpha = 0, have
/// these three each. A particle between contacts of parallel normals may also turn by itself.
///
/// The load is orthogonal to all of them: a contact that a motion does not deform does not transfer the motion of the
/// top wall to it either. So they leave E* determined.
struct FreeMotions {
  std::vector<Pin> pins;            ///< one per motion; under a load in equilibrium they carry no force
  std::vector<FreeMotion> motions;  ///< orthonormal with respect to masses and moments of inertia
};

/// Finds the free motions of all clusters. \throws InputError naming the particles of a cluster that does not touch
/// both walls: nothing determines where it is.
FreeMotions find_free_motions(const Specimen& specimen, const ContactNetwork& network, const PairStiffness& stiffness,
                              const Inertia& inertia);

}  // namespace macadam::harmonic
