// SPDX-License-Identifier: GPL-3.0-or-later
/// \file decay.hpp  Computes the relaxation of a small system of springs and Maxwell units, see reduced_spectrum.cpp.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "macadam/spectrum.hpp"

namespace macadam::harmonic {

/// Springs and Maxwell units between a few motions. The first motion is prescribed.
class Decay {
 public:
  explicit Decay(Eigen::Index motions)
      : at_rest_(Eigen::MatrixXd::Zero(motions, motions)), at_once_(Eigen::MatrixXd::Zero(motions, motions)) {}

  /// Adds the law `series` times the symmetric, positive semidefinite matrix `form`, [motions][motions].
  void add(const PronySeries& series, const Eigen::MatrixXd& form);

  /// Returns the force that holds the first motion after a sudden displacement of one, as a sum of exponentials. All
  /// exponentials of the system, from the eigenvalues of one matrix whose size is the number of strains of dashpots.
  PronySeries all_units() const;

  /// Returns the same force with fewer exponentials, for systems with very many dashpots. The Laplace transform of this
  /// force is exact at six values of s per decade; elsewhere its relative error is below about 1e-10.
  PronySeries few_units() const;

 private:
  /// The equations ẏ = drive − H·y after equilibrium has eliminated the motions, with H = rate·(1 − F·K⁻¹·Fᵀ)·rate.
  struct Equations {
    Eigen::MatrixXd of_free;     ///< F: strains of the dashpots' springs for unit motions, without the first motion
    Eigen::MatrixXd resistance;  ///< K: instantaneous stiffness of these motions
    Eigen::MatrixXd at_rest;     ///< stiffness of these motions at rest
    Eigen::VectorXd scale;       ///< factor on each of these motions in F, K and at_rest
    Eigen::VectorXd rate;        ///< 1/√τ of each strain
    Eigen::VectorXd drive;       ///< c
    double instantaneous = 0;    ///< E_0
  };
  Equations equations() const;
  /// Returns the stiffness at s > 0 of the motions except the first, with rows and columns multiplied by `scale`.
  Eigen::MatrixXd resistance_at(double s, const Eigen::VectorXd& scale) const;
  /// Returns the series with the given decay rates λ and factors of c in the directions of the eigenvectors.
  PronySeries series_of(double instantaneous, const Eigen::VectorXd& lambda, const Eigen::VectorXd& share) const;

  Eigen::MatrixXd at_rest_, at_once_;
  struct AddedLaw {
    PronySeries series;
    Eigen::MatrixXd form;
  };
  std::vector<AddedLaw> laws_;
  std::vector<Eigen::MatrixXd> blocks_;  ///< √g·Lᵀ of each unit
  std::vector<double> rates_;            ///< 1/√τ of each unit
};

}  // namespace macadam::harmonic
