// SPDX-License-Identifier: GPL-3.0-or-later
// reduced_spectrum.cpp  Computes relaxation times from the eigenvalues of one symmetric matrix, with the strains of the
// dashpots as additional variables.
//
// For a pair p, k*(s) = k_p + Σ g_j·s·τ_j/(1 + s·τ_j): a spring k_p beside Maxwell units. At a strain u the spring of
// unit j has the strain u − x_j. Its dashpot has the strain x_j, with ẋ_j = (u − x_j)/τ_j.
//
// Let u = (1, v) be the coefficients of the motions, with the motion of the wall first. Let G_p = L_p·L_pᵀ be the small
// matrix of pair p between the motions, and y_j = √(g_j·τ_j)·L_pᵀ·x_j. Then the energy is
//   V = ½·Σ |√g_j·L_pᵀ·u − y_j/√τ_j|² + ½·uᵀ·(Σ k_p·G_p)·u,
// and ẏ = −∂V/∂y. Equilibrium, ∂V/∂v = 0, eliminates v. This leaves ẏ = c − H·y with a symmetric, positive semidefinite
// H, and the force of the wall is E_0 − cᵀ·y. So each eigenvalue λ of H, with eigenvector q, is 1/τ of one unit, and
// the modulus of that unit is (cᵀ·q)²/λ.
#include "host/spectrum/reduced_spectrum.hpp"

#include <algorithm>
#include <cmath>

namespace macadam::harmonic {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Eigenvalues of a matrix G_p below this fraction of the largest one are rounding errors.
constexpr double rounding = 1e-14;
/// Units with a modulus below this fraction of E_0 are also caused by rounding errors.
constexpr double no_unit = 1e-14;

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

}  // namespace

PronySeries reduced_spectrum(const ReducedModel& model, const std::array<std::optional<Law>, pair_types>& laws,
                             double to_modulus) {
  const Index n = model.motions();
  MatrixXd at_rest = MatrixXd::Zero(n, n), at_once = MatrixXd::Zero(n, n);
  std::vector<MatrixXd> blocks;  // √g·Lᵀ of each unit
  std::vector<double> rates;     // 1/√τ of each unit
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair]) continue;
    const PronySeries series = prony_series(*laws[pair]);
    const double alpha = std::visit([](const auto& law) { return law.alpha; }, *laws[pair]);
    const MatrixXd form = model.form(pair, alpha);
    if (form.isZero(0)) continue;
    at_rest += series.long_term * form;
    at_once += series.instantaneous() * form;
    if (series.units.empty()) continue;
    const MatrixXd root = root_of(form);
    for (const PronySeries::Unit& u : series.units) {
      blocks.emplace_back(std::sqrt(u.modulus) * root);
      rates.push_back(1 / std::sqrt(u.time));
    }
  }
  Index rows = 0;
  for (const MatrixXd& b : blocks) rows += b.rows();
  MatrixXd strain(rows, n);  // all blocks, one below the other
  VectorXd rate(rows);       // 1/√τ of each row
  for (Index at = 0, k = 0; k < std::ssize(blocks); ++k) {
    const MatrixXd& b = blocks[static_cast<std::size_t>(k)];
    strain.middleRows(at, b.rows()) = b;
    rate.segment(at, b.rows()).setConstant(rates[static_cast<std::size_t>(k)]);
    at += b.rows();
  }
  // This solves the equilibrium of all motions except the first one, which the wall prescribes. Degrees of freedom have
  // different units, so rows and columns are scaled by the diagonal.
  const Index free = n - 1;
  const VectorXd scale = at_once.diagonal().tail(free).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * at_once.bottomRightCorner(free, free) * scale.asDiagonal();
  const Eigen::LDLT<MatrixXd> resistance(scaled);
  const MatrixXd of_free = strain.rightCols(free) * scale.asDiagonal();  // the columns of the motions except the first
  const VectorXd pull = scale.asDiagonal() * at_once.bottomLeftCorner(free, 1);
  // −v, where v are the coefficients of the motions in the instantaneous response
  const VectorXd answer = resistance.solve(pull);
  const double instantaneous = at_once(0, 0) - pull.dot(answer);
  MatrixXd decay = -of_free * resistance.solve(of_free.transpose());
  decay.diagonal().array() += 1;
  decay = rate.asDiagonal() * decay * rate.asDiagonal();
  const VectorXd drive = rate.cwiseProduct(strain.col(0) - of_free * answer);
  if (rows == 0) return {to_modulus * instantaneous, {}};  // no law flows
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(0.5 * (decay + decay.transpose()));
  const VectorXd share = eigen.eigenvectors().transpose() * drive;
  PronySeries out;
  double rest = instantaneous;
  for (Index i = rows - 1; i >= 0; --i) {
    const double lambda = eigen.eigenvalues()[i], modulus = share[i] * share[i] / lambda;
    if (!(lambda > 0) || !(modulus > no_unit * instantaneous)) continue;
    out.units.push_back({to_modulus * modulus, 1 / lambda});
    rest -= modulus;
  }
  // if no spring resists at rest, the remainder is the rounding error of E_0
  out.long_term = at_rest.isZero(0) || rest < 1e-12 * instantaneous ? 0 : to_modulus * rest;
  return out;
}

}  // namespace macadam::harmonic
