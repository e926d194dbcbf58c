// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stiffness_matrix.hpp  Assembles the real stiffness matrix of a network, from which the direct solver makes its
/// preconditioner.
#pragma once

#include <Eigen/SparseCore>

#include "host/harmonic/rigid_motions.hpp"

namespace macadam::harmonic {

/// Returns the lower triangle of Σ Re k_pair · K_pair over the pairs, plus the pins, in 6 × 6 blocks for pairs of
/// particles. `place[i]` is the position of particle i in the matrix.
Eigen::SparseMatrix<double> assemble_lower(const ContactNetwork& network, const PairStiffness& stiffness,
                                           const std::vector<std::int32_t>& place, const std::vector<Pin>& pins);

}  // namespace macadam::harmonic
