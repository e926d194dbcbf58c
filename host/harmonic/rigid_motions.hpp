// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rigid_motions.hpp  Finds free motions (motions that no contact resists), and the springs to ground that hold
/// them without carrying force.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/harmonic/contact_operator.hpp"
#include "macadam/specimen.hpp"
#include "macadam/stepper.hpp"

namespace macadam::harmonic {

/// A spring between one particle and ground. Its load is stiffness·direction·(directionᵀ·motion).
struct Pin {
  std::size_t particle;
  std::array<double, 6> direction;  ///< three translations [1], then three rotations [m]
  double stiffness;                 ///< [N/m]

  /// Returns the force of the spring under a motion of all particles, [6·particles].
  Complex force(const Vector& motion) const {
    Complex along = 0;
    for (std::size_t c = 0; c < 6; ++c) along += direction[c] * motion[6 * particle + c];
    return stiffness * along;
  }
};

/// A motion of some particles that no contact resists; all other particles are at rest.
struct FreeMotion {
  std::vector<std::int32_t> particles;  ///< ascending
  std::vector<double> motion;           ///< [particle of the list][6], with motionᵀ·M·motion = 1 [1/√kg]

  /// Removes this motion from another one, [6·particles of the specimen], by projection with respect to masses.
  void remove_from(Vector& other, const Inertia& inertia) const;
};

/// The motions that no contact resists. A specimen between frictionless walls has three of them: along x, along y, and
/// the turn about z. If parts of a specimen are joined only by flat horizontal contacts without shear stiffness, each
/// part has these three motions. An example is a vertical column of spheres with alpha = 0. A particle whose contact
/// normals are all parallel may also turn by itself.
///
/// The load is orthogonal to all free motions. A contact that a free motion does not deform does no work on this
/// motion, so the top wall cannot drive the motion through the contact. Therefore E* is unique, although the amplitudes
/// of the free motions are not.
struct FreeMotions {
  /// One spring per free motion; they carry no force, because the load is orthogonal to free motions.
  std::vector<Pin> pins;
  std::vector<FreeMotion> motions;  ///< orthonormal with respect to masses and moments of inertia
};

/// Returns the free motions of all clusters (sets of particles that contacts join). \throws InputError naming the
/// particles of a cluster that does not touch both walls, because nothing determines its position.
FreeMotions find_free_motions(const Specimen& specimen, const ContactNetwork& network, const PairStiffness& stiffness,
                              const Inertia& inertia);

}  // namespace macadam::harmonic
