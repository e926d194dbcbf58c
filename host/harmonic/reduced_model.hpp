// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reduced_model.hpp  Restricts a specimen to the motions of earlier solutions (a reduced basis). With this
/// restriction E* for other laws is computed within milliseconds.
///
/// K*(s) = Σ k_p·(N_p + α_p·S_p) over the pairs p, with real matrices N and S that do not depend on the laws. The
/// matrices N, S and the mass matrix M are reduced once to the small matrices vᵢᵀ·N·vⱼ, vᵢᵀ·S·vⱼ and vᵢᵀ·M·vⱼ of a few
/// real motions vⱼ, which are at rest at the walls. Afterwards E* for any laws and any s is computed from a small
/// linear system (Galerkin's method, model section 17). If the motions span the real and imaginary parts of a full
/// solution, the reduced model gives the same E* and derivatives as this solution. Otherwise the error of E* grows with
/// the square of the distance between the solution and the span of the motions.
///
/// Contacts with rock in series have stiffnesses of their own. They are divided between classes, each with its own
/// matrices N and S (rock_classes.hpp). The error of E* then also contains the error of these classes.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "host/harmonic/contact_operator.hpp"
#include "host/harmonic/rock_classes.hpp"

namespace macadam::harmonic {

/// The reduced model of one specimen, see the top of this file.
class ReducedModel {
 public:
  /// Specimen and network must outlive this object. `inertia` has the masses of the particles; if it is empty,
  /// solutions have no inertia. `classing` is used only if contacts have rock in series. \throws InputError as
  /// RockClasses.
  ReducedModel(const Specimen& specimen, const ContactNetwork& network, Inertia inertia,
               const RockClassing& classing = {});

  /// Adds the motions of solutions at unit displacement of the top wall (HarmonicResult::motion). Only the parts
  /// outside the span of the present motions are added.
  void add(const std::vector<Vector>& motions);

  struct Solution {
    ModulusParts parts;               ///< parts of E* [Pa]
    Eigen::VectorXcd of_the_motions;  ///< coefficients of the motions
  };
  /// Returns the solution for `load`; HarmonicLoad::near is not used. At least one motion must have been added. `rock`:
  /// factor on the compliances of the rock in series that the network had at first. \throws RunError when the small
  /// system has no finite solution.
  Solution solve(const LawTable& laws, const HarmonicLoad& load, double rock = 1) const;

  /// Returns the motion of the particles, [6·particles], as a start for an iteration (HarmonicLoad::near).
  Vector motion(const Solution& solution) const;

  /// Returns the matrix F of the contacts of a pair type without rock in series, [motions][motions], with entries
  /// vᵢᵀ·(N + α·S)·vⱼ. If the motion of the particles is the sum of the vⱼ with coefficients cⱼ, then k*·cᵀ·F·c is what
  /// this pair type adds to uᵀ·K*·u, where u is that motion and k* the complex stiffness of the pair type's law. The
  /// caller multiplies this by height / cross-section to get the pair type's part of E*.
  Eigen::MatrixXd form(std::size_t pair, double alpha) const { return normal_[pair] + alpha * shear_[pair]; }

  /// The classes of the contacts with rock in series, and their matrices.
  const RockClasses& rock() const { return rock_; }
  const std::vector<RockForms>& rock_forms() const { return in_rock_; }

  /// Number of real motions, including the first, in which the top wall moves.
  Eigen::Index motions() const { return basis_.cols(); }

 private:
  using Matrix = Eigen::MatrixXd;

  /// Returns orthonormal columns that span the parts of `motions` outside the span of the present motions.
  Matrix new_columns(const std::vector<Vector>& motions) const;
  /// Extends the small matrices by the motions `from`, `from` + 1, …
  void project(Eigen::Index from);

  const Specimen& specimen_;
  const ContactNetwork& network_;
  Inertia inertia_;
  /// [6·particles][motions]. In the first motion the top wall moves by one. In all others the top wall is at rest, and
  /// these motions are orthonormal.
  Matrix basis_;
  std::array<Matrix, pair_types> normal_, shear_;  ///< vᵢᵀ·N·vⱼ and vᵢᵀ·S·vⱼ
  Matrix mass_;                                    ///< vᵢᵀ·M·vⱼ
  RockClasses rock_;
  std::vector<RockForms> in_rock_;  ///< one per class
  std::vector<char> has_rock_;      ///< for each contact whether it belongs to classes
};

}  // namespace macadam::harmonic
