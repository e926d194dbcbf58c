// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stiffness_matrix.hpp  A real stiffness matrix of the network, for the preconditioner.
#pragma once

#include <Eigen/SparseCore>

#include "host/harmonic/contact_operator.hpp"

namespace macadam::harmonic {

/// A scalar spring to ground on one degree of freedom.
struct Pin {
  std::size_t dof;
  double stiffness;
};

/// Lower triangle of Σ Re k_pair · K_pair (6 × 6 blocks, particle by particle), pins added. `place[i]` is the position
/// of particle i in the matrix.
Eigen::SparseMatrix<double> assemble_lower(const ContactNetwork& network, const PairStiffness& stiffness,
                                           const std::vector<std::int32_t>& place, const std::vector<Pin>& pins);

}  // namespace macadam::harmonic
