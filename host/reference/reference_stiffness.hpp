// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_stiffness.hpp  The stiffness of a network at its start, point by point.
#pragma once

#include <Eigen/SparseCore>

#include "host/reference/reference_input.hpp"

namespace macadam::reference {

/// K·u for u = (displacement, rotation) of every particle, six numbers each, and what moving the top wall adds. Built
/// from instantaneous stiffnesses with all walls at rest: forces on the particles are −K·u + top_wall·w, the force on
/// the top wall along z is top_wall·u − top_stiffness·w for its displacement w.
struct Stiffness {
  Eigen::SparseMatrix<double> K;  ///< [N/m], [N], [N·m]
  Eigen::VectorXd top_wall;       ///< forces and moments on the particles for a unit displacement of the top wall
  double top_stiffness = 0;       ///< [N/m]
};

/// Assembles the stiffness of a network of `particles` particles.
/// \throws InputError as read_laws and require_network do.
Stiffness assemble_stiffness(const ContactNetwork& network, const LawTable& laws, std::size_t particles);

}  // namespace macadam::reference
