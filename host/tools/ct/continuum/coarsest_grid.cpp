// SPDX-License-Identifier: GPL-3.0-or-later
// coarsest_grid.cpp  Assembles and factorises the matrix of the coarsest grid.
#include "host/tools/ct/continuum/coarsest_grid.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "host/tools/ct/continuum/element.hpp"
#include "macadam/error.hpp"

namespace macadam::continuum {

struct CoarsestGrid::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<Complex>> lu;
  std::size_t nodes;
};

CoarsestGrid::CoarsestGrid(const Grid<float>& grid) : factors_(std::make_unique<Factors>()) {
  const std::size_t nodes = factors_->nodes = grid.size.nodes();
  const Size n = grid.size;
  std::vector<Eigen::Triplet<Complex>> entries;
  std::vector<Complex> diagonal(3 * nodes);
  const auto held = [&](std::size_t node, int i) {
    const std::size_t layer = std::size_t(n.x + 1) * (n.y + 1);
    return i == 2 && (node < layer || node >= layer * n.z);
  };
  for (int k = 0; k < n.z; ++k) {
    const ElementStiffness unit(grid.height[std::size_t(k)]);
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const std::size_t e = n.element(i, j, k);
        std::size_t node[corners];
        for (int c = 0; c < corners; ++c) node[c] = n.node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
        for (int a = 0; a < dofs; ++a)
          for (int b = 0; b < dofs; ++b) {
            if (held(node[a / 3], a % 3) || held(node[b / 3], b % 3)) continue;
            const Complex value = Complex(grid.lambda[e]) * unit.lambda[a][b] + Complex(grid.mu[e]) * unit.mu[a][b];
            const auto row = 3 * node[a / 3] + a % 3, column = 3 * node[b / 3] + b % 3;
            entries.emplace_back(int(row), int(column), value);
            if (row == column) diagonal[row] += value;
          }
      }
  }
  double largest = 0;
  for (const Complex& value : diagonal) largest = std::max(largest, std::abs(value));
  for (std::size_t row = 0; row < diagonal.size(); ++row)
    entries.emplace_back(int(row), int(row), diagonal[row] == Complex{} ? largest : 1e-6 * largest);
  Eigen::SparseMatrix<Complex> matrix(Eigen::Index(3 * nodes), Eigen::Index(3 * nodes));
  matrix.setFromTriplets(entries.begin(), entries.end());
  factors_->lu.compute(matrix);
  if (factors_->lu.info() != Eigen::Success)
    throw RunError("finite elements: the matrix of the coarsest grid cannot be factorised");
}
CoarsestGrid::~CoarsestGrid() = default;

void CoarsestGrid::solve(const Field<float>& r, Field<float>& u) const {
  const std::size_t nodes = factors_->nodes;
  Eigen::VectorXcd b(Eigen::Index(3 * nodes));
  for (std::size_t n = 0; n < nodes; ++n)
    for (int i = 0; i < 3; ++i) b[Eigen::Index(3 * n) + i] = Complex(r.of[i][n]);
  const Eigen::VectorXcd x = factors_->lu.solve(b);
  for (std::size_t n = 0; n < nodes; ++n)
    for (int i = 0; i < 3; ++i) u.of[i][n] = std::complex<float>(x[Eigen::Index(3 * n) + i]);
}

}  // namespace macadam::continuum
