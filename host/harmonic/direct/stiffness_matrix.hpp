// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stiffness_matrix.hpp  Assembles the real stiffness matrix of a network, from which the direct solver makes its
/// preconditioner.
#pragma once

#include <Eigen/SparseCore>

#include "host/harmonic/rigid_motions.hpp"

namespace macadam::harmonic {

/// Returns the lower triangle of Σ Re k_p · K_p over the pair types p, plus the stiffness of the pins. The matrix has a
/// 6 × 6 block for every two particles in contact and for every particle. `place[i]` is the position of particle i in
/// the matrix.
Eigen::SparseMatrix<double> assemble_lower(const ContactNetwork& network, const PairStiffness& stiffness,
                                           const std::vector<std::int32_t>& place, const std::vector<Pin>& pins);

}  // namespace macadam::harmonic
