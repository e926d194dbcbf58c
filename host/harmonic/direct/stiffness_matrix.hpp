// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stiffness_matrix.hpp  A real stiffness matrix of the network, for the preconditioner.
#pragma once

#include <Eigen/SparseCore>

#include "host/harmonic/rigid_motions.hpp"

namespace macadam::harmonic {

/// Lower triangle of Σ Re k_pair · K_pair (6 × 6 blocks, particle by particle), pins added. `place[i]` is the position
/// of particle i in the matrix.
Eigen::SparseMatrix<double> assemble_lower(const ContactNetwork& network, const PairStiffness& stiffness,
                                           const std::vector<std::int32_t>& place, const std::vector<Pin>& pins);

}  // namespace macadam::harmonic
