// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cholesky.hpp  Cholesky factors of a real stiffness matrix (CHOLMOD), applied to complex vectors.
#pragma once

#include <memory>

#include "host/harmonic/direct/stiffness_matrix.hpp"

namespace macadam::harmonic {

class Cholesky {
 public:
  /// Orders the particles (METIS nested dissection on the contact graph), assembles and factors.
  /// \throws RunError when the matrix is not positive definite (a mechanism) or memory does not suffice.
  Cholesky(const ContactNetwork& network, std::size_t particles, const PairStiffness& stiffness,
           const std::vector<Pin>& pins);
  ~Cholesky();

  /// out = M⁻¹·in
  void solve(const Vector& in, Vector& out) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace macadam::harmonic
