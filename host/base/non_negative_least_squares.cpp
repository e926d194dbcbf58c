// SPDX-License-Identifier: GPL-3.0-or-later
// non_negative_least_squares.cpp  Implements Lawson and Hanson's algorithm NNLS, with columns scaled to length one.
#include "host/base/non_negative_least_squares.hpp"

#include <vector>

namespace macadam::fitting {

Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& b, double enough) {
  const Eigen::Index n = matrix.cols();
  Eigen::VectorXd length = matrix.colwise().norm().transpose();
  for (double& l : length)
    if (!(l > 0)) l = 1;
  const Eigen::MatrixXd A = matrix * length.cwiseInverse().asDiagonal();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<bool> free(static_cast<std::size_t>(n), false);
  const double rounding = 1e-13 * b.norm();
  // Usually about 3·n iterations are needed. The limit of 10·n ends cycles between equally good unknowns, which would
  // repeat forever.
  for (Eigen::Index round = 0; round < 10 * n; ++round) {
    const Eigen::VectorXd rest = b - A * x, gradient = A.transpose() * rest;
    if (rest.cwiseAbs().maxCoeff() <= enough) break;
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!free[static_cast<std::size_t>(i)] && gradient[i] > rounding && (best < 0 || gradient[i] > gradient[best]))
        best = i;
    if (best < 0) break;
    free[static_cast<std::size_t>(best)] = true;
    while (true) {
      std::vector<Eigen::Index> columns;
      for (Eigen::Index i = 0; i < n; ++i)
        if (free[static_cast<std::size_t>(i)]) columns.push_back(i);
      if (columns.empty()) break;
      const Eigen::VectorXd z = A(Eigen::all, columns).colPivHouseholderQr().solve(b);
      double step = 1;  // fraction of the way from x to z at which the first unknown becomes 0
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const auto at = static_cast<Eigen::Index>(c);
        if (z[at] <= 0) step = std::min(step, x[columns[c]] / std::max(x[columns[c]] - z[at], 1e-300));
      }
      bool left = false;
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const auto at = static_cast<Eigen::Index>(c);
        x[columns[c]] += step * (z[at] - x[columns[c]]);
        if (z[at] <= 0 && x[columns[c]] <= 1e-14 * x.maxCoeff()) {
          x[columns[c]] = 0;
          free[static_cast<std::size_t>(columns[c])] = false;
          left = true;
        }
      }
      if (!left) break;
    }
  }
  return x.cwiseQuotient(length);
}

}  // namespace macadam::fitting
