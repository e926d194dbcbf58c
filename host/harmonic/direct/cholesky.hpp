// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cholesky.hpp  Computes the Cholesky factors of a real stiffness matrix by CHOLMOD, and applies them to complex
/// vectors.
#pragma once

#include <memory>

#include "host/harmonic/direct/stiffness_matrix.hpp"

namespace macadam::harmonic {

/// The Cholesky factors of one matrix. The factors are computed once and used in every iteration of the direct solver.
class Cholesky {
 public:
  /// Orders the particles (METIS nested dissection on the contact graph), assembles the matrix and factors it.
  /// \throws RunError when the matrix is not positive definite (a mechanism) or memory does not suffice.
  Cholesky(const ContactNetwork& network, std::size_t particles, const PairStiffness& stiffness,
           const std::vector<Pin>& pins);
  ~Cholesky();

  /// Computes out = M⁻¹·in, for real and imaginary parts together; M is the factored matrix.
  void solve(const Vector& in, Vector& out) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace macadam::harmonic
