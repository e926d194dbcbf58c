// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_stiffness.hpp  The stiffness matrix of a network in its initial geometry, summed point by point.
#pragma once

#include <Eigen/SparseCore>

#include "host/reference/reference_input.hpp"

namespace macadam::reference {

/// The stiffness matrix K for u = (displacement, rotation) of every particle, six numbers each, and the effect of
/// moving the top wall. For instantaneous stiffnesses and all other walls at rest, the loads on the particles are −K·u
/// + top_wall·w when the displacement of the top wall is w. The force on the top wall along z is top_wall·u −
/// top_stiffness·w.
struct Stiffness {
  Eigen::SparseMatrix<double> K;  ///< [N/m], [N], [N·m]
  Eigen::VectorXd top_wall;       ///< forces and moments on the particles for a unit displacement of the top wall
  double top_stiffness = 0;       ///< [N/m]
};

/// Returns the stiffness of a network with this number of particles.
/// \throws InputError as read_laws and require_network do.
Stiffness assemble_stiffness(const ContactNetwork& network, const LawTable& laws, std::size_t particles);

}  // namespace macadam::reference
