// SPDX-License-Identifier: GPL-3.0-or-later
// extrapolation.cpp  Fits polynomials in the edge of the voxels that share their value at zero.
#include "bench/continuum/extrapolation.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace continuum {
namespace {

/// Returns the common value at h = 0 of polynomials through the finest degree + 1 sizes of each rule, for the modulus
/// (first) and Poisson's ratio.
Eigen::RowVector2cd limit(const std::vector<const Sizes*>& rules, int degree) {
  const Eigen::Index rows = Eigen::Index(rules.size()) * (degree + 1),
                     unknowns = 1 + Eigen::Index(rules.size()) * degree;
  Eigen::MatrixXd powers = Eigen::MatrixXd::Zero(rows, unknowns);
  Eigen::MatrixX2cd values(rows, 2);
  Eigen::Index row = 0;
  for (std::size_t rule = 0; rule < rules.size(); ++rule)
    for (auto at = rules[rule]->end() - degree - 1; at != rules[rule]->end(); ++at, ++row) {
      powers(row, 0) = 1;
      const double h = at->voxel / rules[rule]->back().voxel;
      for (int p = 0; p < degree; ++p) powers(row, 1 + Eigen::Index(rule) * degree + p) = std::pow(h, p + 1);
      values.row(row) << at->modulus, at->poisson;
    }
  const Eigen::MatrixXcd fit = powers.cast<Complex>().colPivHouseholderQr().solve(values);
  return fit.row(0);
}

}  // namespace

Limit extrapolated(const Sizes& stiff, const Sizes& soft) {
  const int degree = stiff.size() > 2 ? 2 : 1;
  const auto common = limit({&stiff, &soft}, degree);
  Limit out{common[0], common[1]};
  for (const Complex& other : {limit({&stiff}, degree)[0], limit({&soft}, degree)[0], limit({&stiff, &soft}, 1)[0]}) {
    out.uncertainty = std::max(out.uncertainty, std::abs(std::abs(other) - std::abs(out.modulus)));
    out.phase_uncertainty = std::max(out.phase_uncertainty, std::abs(std::arg(other / out.modulus)));
  }
  return out;
}

}  // namespace continuum
