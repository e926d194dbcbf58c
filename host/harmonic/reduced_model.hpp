// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reduced_model.hpp  A specimen held to the motions that it was seen to have: E* for other laws, at once.
///
/// K*(s) = Σ k_p·(N_p + α_p·S_p) over the pairs p, with real N and S that no law changes. Between real motions v_j,
/// which rest at the walls, N, S and M become small matrices, once; then any laws and any s take a small linear system.
/// Where the real and imaginary parts of a solution are among the motions, E* there is that of the solution, and so are
/// its derivatives; elsewhere its error goes with the square of the distance (Galerkin's method).
#pragma once

#include <Eigen/Dense>
#include <array>

#include "host/harmonic/contact_operator.hpp"

namespace macadam::harmonic {

class ReducedModel {
 public:
  /// Specimen and network must outlive it. \param inertia  of the particles; empty: none in any solution.
  ReducedModel(const Specimen& specimen, const ContactNetwork& network, Inertia inertia);

  /// Motions that solutions have at unit displacement of the top wall (HarmonicResult::motion) join. What is among
  /// them already is left out.
  void add(const std::vector<Vector>& motions);

  struct Solution {
    ModulusParts parts;               ///< of E* [Pa]
    Eigen::VectorXcd of_the_motions;  ///< how much of each the motion has
  };
  /// Of `load`, whose `near` is not used. At least one motion must be there. \throws RunError where nothing finite
  /// solves it.
  Solution solve(const LawTable& laws, const HarmonicLoad& load) const;

  /// The particles' motion, to begin an iteration at (HarmonicLoad::near).
  Vector motion(const Solution& solution) const;

  /// uᵀ·K·u of a pair per k*, between the motions: N + α·S. Not over the specimen's size.
  Eigen::MatrixXd form(std::size_t pair, double alpha) const { return normal_[pair] + alpha * shear_[pair]; }

  Eigen::Index motions() const { return basis_.cols(); }  ///< real ones, the first included

 private:
  using Matrix = Eigen::MatrixXd;

  /// What the motions bring beside those that are there, orthonormal.
  Matrix new_columns(const std::vector<Vector>& motions) const;
  void project(Eigen::Index from);

  const Specimen& specimen_;
  const ContactNetwork& network_;
  Inertia inertia_;
  Matrix basis_;  ///< [6·particles][motions]; the first goes with the wall, the others rest there and are orthonormal
  std::array<Matrix, pair_types> normal_, shear_;  ///< vᵢᵀ·N·vⱼ and vᵢᵀ·S·vⱼ
  Matrix mass_;                                    ///< vᵢᵀ·M·vⱼ
};

}  // namespace macadam::harmonic
