// SPDX-License-Identifier: GPL-3.0-or-later
/// \file modes.hpp  Energy of a linear elastic assembly from the forces that it shows.
#pragma once

#include <Eigen/Core>

#include "tests/test_scenes.hpp"

namespace macadam::stability {

/// Modes of M^(-1/2)·K·M^(-1/2), dense: some hundred particles. K is the reference's, geometry of the start, area
/// moments of the network's quadrature.
class Modes {
 public:
  explicit Modes(const test::TestScene& scene);

  /// H = ½·v(k−½)·M·v(k+½) + ½·F·K⁺·F [J], which leapfrog keeps exactly for elastic contacts and fixed geometry. The
  /// rotations that the elastic part needs are nowhere stored; the forces F = −K·q say as much.
  double energy(const ParticleState& state, double dt) const;

  /// Takes the rigid part away from velocities and spins, so that the assembly neither drifts nor turns.
  void remove_rigid_part(std::vector<Vec3d>& velocity, std::vector<Vec3d>& spin) const;

 private:
  Eigen::VectorXd root_mass_;  ///< √m and √I, six a particle
  Eigen::VectorXd square_;     ///< ω² of the modes that are not rigid
  Eigen::MatrixXd shape_;      ///< their columns
};

/// Linear momentum, and angular momentum about the origin at the places of the start.
struct Momenta {
  Vec3d linear, angular;
};
Momenta momenta(const test::TestScene& scene, const ParticleState& state, bool displaced = false);

}  // namespace macadam::stability
