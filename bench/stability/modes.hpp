// SPDX-License-Identifier: GPL-3.0-or-later
/// \file modes.hpp  Computes the energy of a linear elastic assembly from the forces on its particles.
#pragma once

#include <Eigen/Core>

#include "tests/support/test_scenes.hpp"

namespace macadam::stability {

/// The eigenmodes of M^(-1/2)·K·M^(-1/2), computed with dense matrices, for some hundred particles. K comes from the
/// reference implementation, with the initial geometry and the area moments of the network's quadrature.
class Modes {
 public:
  explicit Modes(const test::TestScene& scene);

  /// Returns H = ½·v(k−½)·M·v(k+½) + ½·F·K⁺·F [J], which leapfrog keeps exactly for elastic contacts and fixed
  /// geometry. The elastic energy is computed from the forces F = −K·q, because the rotations in q are not stored.
  double energy(const ParticleState& state, double dt) const;

  /// Removes the rigid motion from velocities and spins, so that the assembly neither drifts nor turns.
  void remove_rigid_part(std::vector<Vec3d>& velocity, std::vector<Vec3d>& spin) const;

 private:
  Eigen::VectorXd root_mass_;  ///< √m and √I, six values per particle
  Eigen::VectorXd square_;     ///< ω² of the modes that are not rigid
  Eigen::MatrixXd shape_;      ///< eigenvectors of these modes, one per column
};

/// Linear momentum, and angular momentum about the origin.
struct Momenta {
  Vec3d linear, angular;
};
/// Computes the momenta with the initial positions or, with `displaced`, the current ones.
Momenta momenta(const test::TestScene& scene, const ParticleState& state, bool displaced = false);

}  // namespace macadam::stability
