// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tangent_solver.hpp  Declares the linear solvers of Newton's method on the CPU.
#pragma once

#include <memory>

#include "host/quasi_static/tangent_matrix.hpp"

namespace macadam::quasi_static {

/// How a linear system was solved.
struct LinearReport {
  bool solved = false;
  int iterations = 0;
  bool negative = false;    ///< whether a direction of negative stiffness was found
  int negative_pivots = 0;  ///< of the factors; 0 for iterative solvers
};

class TangentSolver {
 public:
  virtual ~TangentSolver() = default;
  /// Whether the solver needs a symmetric matrix.
  virtual bool wants_symmetric() const = 0;
  /// Prepares solutions with this matrix, which must not change until the last of them.
  virtual LinearReport prepare(const TangentMatrix& matrix) = 0;
  /// Solves K·x = right. `tolerance`: relative residual; factors reach rounding error.
  virtual LinearReport solve(const Vector& right, Vector& x, double tolerance) = 0;
  virtual const char* name() const = 0;
};

/// Factors of the matrix: LDLᵀ of a symmetric matrix, LU of an unsymmetric one.
std::unique_ptr<TangentSolver> make_direct_solver();
/// Conjugate gradients for symmetric matrices, GMRES for others and where conjugate gradients fail. The preconditioner
/// has the inverse block of each particle, and the rigid motions of boxes of particles.
std::unique_ptr<TangentSolver> make_iterative_solver(const Specimen& specimen);

}  // namespace macadam::quasi_static
