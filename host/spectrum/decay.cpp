// SPDX-License-Identifier: GPL-3.0-or-later
// decay.cpp  Computes relaxation times from the eigenvalues of one symmetric matrix, with the strains of the dashpots
// as additional variables.
//
// For a law p, k*(s) = k_p + Σ g_j·s·τ_j/(1 + s·τ_j): a spring k_p beside Maxwell units. At a strain u the spring of
// unit j has the strain u − x_j. Its dashpot has the strain x_j, with ẋ_j = (u − x_j)/τ_j.
//
// Let u = (1, v) be the coefficients of the motions, with the motion of the wall first. Let G_p = L_p·L_pᵀ be the small
// matrix of law p between the motions, and y_j = √(g_j·τ_j)·L_pᵀ·x_j. Then the energy is
//   V = ½·Σ |√g_j·L_pᵀ·u − y_j/√τ_j|² + ½·uᵀ·(Σ k_p·G_p)·u,
// and ẏ = −∂V/∂y. Equilibrium, ∂V/∂v = 0, eliminates v. This leaves ẏ = c − H·y with a symmetric, positive semidefinite
// H, and the force of the wall is E_0 − cᵀ·y. So each eigenvalue λ of H, with eigenvector q, is 1/τ of one unit, and
// the modulus of that unit is (cᵀ·q)²/λ.
#include "host/spectrum/decay.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/base/parallel.hpp"

namespace macadam::harmonic {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Eigenvalues of a matrix G_p below this fraction of the largest one are rounding errors.
constexpr double rounding = 1e-14;
/// Units with a modulus below this fraction of E_0 are also caused by rounding errors.
constexpr double no_unit = 1e-14;
/// few_units() uses y at values of s from `below` times the lowest rate 1/τ of a law to `above` times the highest one.
constexpr double below = 1e-4, above = 10;
constexpr int per_decade = 6;
/// A vector is not used if its part outside the span of the others is shorter than this fraction of it.
constexpr double least_remainder = 1e-9;

/// Returns Lᵀ with L·Lᵀ = `form`. It has one row for each direction in which `form` has stiffness.
MatrixXd root_of(const MatrixXd& form) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(form);
  const VectorXd& values = eigen.eigenvalues();
  const double least = rounding * std::max(values.maxCoeff(), 0.0);
  Index first = 0;
  while (first < values.size() && values[first] <= least) ++first;
  const Index rank = values.size() - first;
  return values.tail(rank).cwiseSqrt().asDiagonal() * eigen.eigenvectors().rightCols(rank).transpose();
}

/// Makes the columns orthonormal in their order, and returns those that are not in the span of the columns before them.
MatrixXd orthonormal(MatrixXd columns) {
  Index kept = 0;
  for (Index j = 0; j < columns.cols(); ++j) {
    VectorXd x = columns.col(j);
    const double whole = x.norm();
    for (int twice = 0; twice < 2; ++twice) {  // the second pass removes the rounding error of the first
      const auto before = columns.leftCols(kept);
      x -= before * (before.transpose() * x).eval();
    }
    const double rest = x.norm();
    if (rest > least_remainder * whole) columns.col(kept++) = x / rest;
  }
  return columns.leftCols(kept);
}

}  // namespace

void Decay::add(const PronySeries& series, const MatrixXd& form) {
  if (form.isZero(0)) return;
  at_rest_ += series.long_term * form;
  at_once_ += series.instantaneous() * form;
  laws_.push_back({series, form});
  if (series.units.empty()) return;
  const MatrixXd root = root_of(form);
  for (const PronySeries::Unit& u : series.units) {
    blocks_.emplace_back(std::sqrt(u.modulus) * root);
    rates_.push_back(1 / std::sqrt(u.time));
  }
}

Decay::Equations Decay::equations() const {
  const Index n = at_once_.cols(), free = n - 1;
  Index rows = 0;
  for (const MatrixXd& b : blocks_) rows += b.rows();
  MatrixXd strain(rows, n);  // all blocks, one below the other
  Equations out;
  out.rate.resize(rows);
  for (Index at = 0, k = 0; k < std::ssize(blocks_); ++k) {
    const MatrixXd& b = blocks_[static_cast<std::size_t>(k)];
    strain.middleRows(at, b.rows()) = b;
    out.rate.segment(at, b.rows()).setConstant(rates_[static_cast<std::size_t>(k)]);
    at += b.rows();
  }
  // This solves the equilibrium of all motions except the first one, which the wall prescribes. Degrees of freedom have
  // different units, so rows and columns are scaled by the diagonal.
  const VectorXd scale = at_once_.diagonal().tail(free).cwiseSqrt().cwiseInverse();
  out.scale = scale;
  out.resistance = scale.asDiagonal() * at_once_.bottomRightCorner(free, free) * scale.asDiagonal();
  out.at_rest = scale.asDiagonal() * at_rest_.bottomRightCorner(free, free) * scale.asDiagonal();
  out.of_free = strain.rightCols(free) * scale.asDiagonal();
  const VectorXd pull = scale.asDiagonal() * at_once_.bottomLeftCorner(free, 1);
  // −v, where v are the coefficients of the motions in the instantaneous response
  const VectorXd answer = Eigen::LDLT<MatrixXd>(out.resistance).solve(pull);
  out.instantaneous = at_once_(0, 0) - pull.dot(answer);
  out.drive = out.rate.cwiseProduct(strain.col(0) - out.of_free * answer);
  return out;
}

MatrixXd Decay::resistance_at(double s, const VectorXd& scale) const {
  const Index free = scale.size();
  MatrixXd out = MatrixXd::Zero(free, free);
  for (const auto& [series, form] : laws_) {
    double stiffness = series.long_term;
    for (const PronySeries::Unit& u : series.units) stiffness += u.modulus * (s * u.time / (1 + s * u.time));
    out += stiffness * form.bottomRightCorner(free, free);
  }
  return scale.asDiagonal() * out * scale.asDiagonal();
}

PronySeries Decay::series_of(double instantaneous, const VectorXd& lambda, const VectorXd& share) const {
  PronySeries out;
  double rest = instantaneous;
  for (Index i = lambda.size() - 1; i >= 0; --i) {
    const double modulus = share[i] * share[i] / lambda[i];
    if (!(lambda[i] > 0) || !(modulus > no_unit * instantaneous)) continue;
    out.units.push_back({modulus, 1 / lambda[i]});
    rest -= modulus;
  }
  // if no spring resists at rest, the remainder is the rounding error of E_0
  out.long_term = at_rest_.isZero(0) || rest < 1e-12 * instantaneous ? 0 : rest;
  return out;
}

PronySeries Decay::all_units() const {
  const Equations e = equations();
  if (e.rate.size() == 0) return {e.instantaneous, {}};  // no law flows
  MatrixXd decay = -e.of_free * Eigen::LDLT<MatrixXd>(e.resistance).solve(e.of_free.transpose());
  decay.diagonal().array() += 1;
  decay = e.rate.asDiagonal() * decay * e.rate.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(0.5 * (decay + decay.transpose()));
  return series_of(e.instantaneous, eigen.eigenvalues(), eigen.eigenvectors().transpose() * e.drive);
}

// H is restricted to the span of (s + H)⁻¹·c at several real s (a rational Krylov space). The projection is exact at
// these s. With the distance h = ln 10/per_decade of ln s, its relative error is about exp(−2π²/h) between them and
// exp(−π²/h), 7e-12, for imaginary s.
PronySeries Decay::few_units() const {
  const Equations e = equations();
  if (e.rate.size() == 0) return {e.instantaneous, {}};
  const VectorXd square = e.rate.cwiseAbs2();
  std::vector<double> places = log_range(below * square.minCoeff(), above * square.maxCoeff(), per_decade);
  std::reverse(places.begin(), places.end());  // fast modes first, so that the rounding of fast modes spares slow ones
  MatrixXd states(e.rate.size(), std::ssize(places));
  for_each_in_parallel(places.size(), [&](std::size_t i) {
    const double s = places[i];
    const VectorXd weight = (square.array() + s).inverse();
    // (s + H)⁻¹·c by the formula of Woodbury, with K(s), the stiffness of the motions at s, as a sum of positive terms
    const MatrixXd resistance = resistance_at(s, e.scale);
    const VectorXd plain = weight.cwiseProduct(e.drive);
    const VectorXd motion = Eigen::LDLT<MatrixXd>(resistance).solve(e.of_free.transpose() * e.rate.cwiseProduct(plain));
    states.col(static_cast<Index>(i)) = plain + weight.cwiseProduct(e.rate).cwiseProduct(e.of_free * motion);
  });
  const MatrixXd basis = orthonormal(std::move(states));
  // yᵀ·H·y is the energy of the springs for the strains y of the dashpots. It is computed as a sum of squares, in which
  // the small energies of slow modes are not lost.
  MatrixXd springs = e.rate.asDiagonal() * basis;
  const MatrixXd motions = Eigen::LDLT<MatrixXd>(e.resistance).solve(e.of_free.transpose() * springs);
  springs -= e.of_free * motions;
  const MatrixXd decay = springs.transpose() * springs + motions.transpose() * e.at_rest * motions;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(0.5 * (decay + decay.transpose()));
  return series_of(e.instantaneous, eigen.eigenvalues(),
                   eigen.eigenvectors().transpose() * (basis.transpose() * e.drive));
}

}  // namespace macadam::harmonic
