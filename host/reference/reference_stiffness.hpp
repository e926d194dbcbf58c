// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_stiffness.hpp  Computes the stiffness matrix of a network in its initial geometry, summed point by
/// point.
#pragma once

#include <Eigen/SparseCore>

#include "host/reference/reference_input.hpp"

namespace macadam::reference {

/// The stiffness matrix K for the vector u of all displacements and rotations (six numbers per particle), and the
/// effect of a displacement of the top wall. All other walls are at rest, and stiffnesses are instantaneous. If w is
/// the displacement of the top wall, then
///   loads on the particles:         −K·u + top_wall·w
///   force on the top wall along z:  top_wall·u − top_stiffness·w
struct Stiffness {
  Eigen::SparseMatrix<double> K;  ///< [N/m], [N], [N·m]
  Eigen::VectorXd top_wall;       ///< forces and moments on the particles for a unit displacement of the top wall
  double top_stiffness = 0;       ///< [N/m]
};

/// Returns the stiffness of a network with this number of particles.
/// \throws InputError as read_laws and require_network do.
Stiffness assemble_stiffness(const ContactNetwork& network, const LawTable& laws, std::size_t particles);

}  // namespace macadam::reference
