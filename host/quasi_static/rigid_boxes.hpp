// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rigid_boxes.hpp  Divides the particles among boxes, and solves the system for rigid motions of these boxes:
/// the coarse level of the iterative solver's preconditioner.
#pragma once

#include <Eigen/SparseCholesky>
#include <cstdint>
#include <vector>

#include "host/quasi_static/tangent_matrix.hpp"

namespace macadam::quasi_static {

class RigidBoxes {
 public:
  /// `per_box`: mean number of particles per box.
  RigidBoxes(const Specimen& specimen, double per_box);

  /// Factors RᵀKR, of which it takes the upper triangle, where R are the rigid motions, as L·D·Lᵀ, and replaces D by
  /// |D|. So L·|D|·Lᵀ is positive definite also where cracks make K lose its stability.
  void factor(const TangentMatrix& matrix);
  /// Adds R·(L·|D|·Lᵀ)⁻¹·Rᵀ·x to `out`.
  void add_solution(const Vector& x, Vector& out) const;
  std::size_t boxes() const { return begin_.size() - 1; }

 private:
  /// Returns the motion of a particle under the rigid motions of its box.
  Block motion(std::size_t particle) const;

  std::vector<std::int32_t> box_of_;
  std::vector<std::uint32_t> members_;  ///< particles, box by box
  std::vector<std::size_t> begin_;
  std::vector<Vec3d> lever_;  ///< from the centre of the box to the particle [m]
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  Eigen::VectorXd pivots_;  ///< |D|; empty: no factors
};

}  // namespace macadam::quasi_static
