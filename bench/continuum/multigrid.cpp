// SPDX-License-Identifier: GPL-3.0-or-later
// multigrid.cpp  Implements the levels of a multigrid cycle: smoothing, restriction and interpolation, and the coarsest
// solution.
#include "bench/continuum/multigrid.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace continuum {
namespace {

using Single = std::complex<float>;

/// Degree of the smoother's polynomial, and the smallest eigenvalue that it damps, divided by the largest eigenvalue.
/// With these values a specimen of 41 balls with voxels of 0.5 mm (ratio of moduli 14) needs 12 to 13 iterations. Other
/// values were not tried.
constexpr int smoothing_degree = 3;
constexpr float smoothed_part = 0.12F;

/// Calls f for every node, in parallel.
template <class F>
void each_node(std::size_t nodes, F&& f) {
  const auto n = std::ptrdiff_t(nodes);
#pragma omp parallel for
  for (std::ptrdiff_t i = 0; i < n; ++i) f(std::size_t(i));
}

}  // namespace

struct Multigrid::Level {
  Grid<float> grid;
  std::vector<std::array<Single, 9>> inverse;
  Field<float> u, r, force, change;
  float largest = 0;  ///< largest eigenvalue of the preconditioned matrix, with a margin

  explicit Level(Grid<float> of)
      : grid(std::move(of)),
        inverse(grid.inverse_diagonal()),
        u(grid.size.nodes()),
        r(u),
        force(u),
        change(u),
        largest(estimate()) {}

  /// Returns component i of the product of a node's inverse diagonal block with its vector.
  Single preconditioned(const Field<float>& of, std::size_t node, int i) const {
    const auto& d = inverse[node];
    return d[3 * i] * of.of[0][node] + d[3 * i + 1] * of.of[1][node] + d[3 * i + 2] * of.of[2][node];
  }

  /// Returns 1.1 times the estimate of the largest eigenvalue by 15 steps of the power method.
  float estimate() {
    Field<float> x(grid.size.nodes());
    std::uint32_t state = 1;
    for (auto& component : x.of)
      for (auto& value : component)
        value = float((state = state * 1664525U + 1013904223U) >> 8) / float(1 << 24) - 0.5F;
    double norm = 1;
    for (int step = 0; step < 15; ++step) {
      grid.apply(x, force);
      norm = 0;
      for (std::size_t n = 0; n < inverse.size(); ++n)
        for (int i = 0; i < 3; ++i) norm += std::norm(x.of[i][n] = preconditioned(force, n, i));
      norm = std::sqrt(norm);
      for (auto& component : x.of)
        for (auto& value : component) value /= float(norm);
    }
    for (auto& component : force.of) std::fill(component.begin(), component.end(), Single{});
    return float(1.1 * norm);
  }

  /// Improves u for the right-hand side r by a Chebyshev polynomial. `zero`: u is zero at the start.
  void smooth(bool zero) {
    const float low = smoothed_part * largest, centre = (largest + low) / 2, half = (largest - low) / 2;
    float rho = half / centre;
    for (int k = 0; k < smoothing_degree; ++k) {
      const bool first = k == 0;
      if (!(first && zero)) grid.apply(u, force);
      const float next = first ? rho : 1 / (2 * centre / half - rho);
      const float keep = first ? 0 : next * rho, gain = first ? 1 / centre : 2 * next / half;
      each_node(inverse.size(), [&](std::size_t n) {
        Single residual[3];
        for (int i = 0; i < 3; ++i) residual[i] = r.of[i][n] - (first && zero ? Single{} : force.of[i][n]);
        const auto& d = inverse[n];
        for (int i = 0; i < 3; ++i) {
          const Single step = d[3 * i] * residual[0] + d[3 * i + 1] * residual[1] + d[3 * i + 2] * residual[2];
          change.of[i][n] = keep * change.of[i][n] + gain * step;
        }
        for (int i = 0; i < 3; ++i) u.of[i][n] = (first && zero ? Single{} : u.of[i][n]) + change.of[i][n];
      });
      rho = next;
    }
  }
};

/// The coarsest level. Motions of the whole body that no boundary holds get a stiffness of 1e-6 of the largest
/// diagonal element, so that the matrix is regular; the solver removes these motions.
struct Multigrid::Coarsest {
  Eigen::SparseLU<Eigen::SparseMatrix<Complex>> factors;
  std::size_t nodes;

  explicit Coarsest(const Grid<float>& grid) : nodes(grid.size.nodes()) {
    const ElementStiffness unit;
    const Size n = grid.size;
    std::vector<Eigen::Triplet<Complex>> entries;
    std::vector<Complex> diagonal(3 * nodes);
    const auto held = [&](std::size_t node, int i) {
      const std::size_t layer = std::size_t(n.x + 1) * (n.y + 1);
      return i == 2 && (node < layer || node >= layer * n.z);
    };
    for (int k = 0; k < n.z; ++k)
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
    double largest = 0;
    for (const Complex& value : diagonal) largest = std::max(largest, std::abs(value));
    for (std::size_t row = 0; row < diagonal.size(); ++row)
      entries.emplace_back(int(row), int(row), diagonal[row] == Complex{} ? largest : 1e-6 * largest);
    Eigen::SparseMatrix<Complex> matrix(Eigen::Index(3 * nodes), Eigen::Index(3 * nodes));
    matrix.setFromTriplets(entries.begin(), entries.end());
    factors.compute(matrix);
  }
  void solve(const Field<float>& r, Field<float>& u) {
    Eigen::VectorXcd b(Eigen::Index(3 * nodes));
    for (std::size_t n = 0; n < nodes; ++n)
      for (int i = 0; i < 3; ++i) b[Eigen::Index(3 * n) + i] = Complex(r.of[i][n]);
    const Eigen::VectorXcd x = factors.solve(b);
    for (std::size_t n = 0; n < nodes; ++n)
      for (int i = 0; i < 3; ++i) u.of[i][n] = Single(x[Eigen::Index(3 * n) + i]);
  }
};

Multigrid::Multigrid(const Grid<double>& grid) {
  Grid<float> level;
  level.size = grid.size;
  level.lambda.assign(grid.lambda.begin(), grid.lambda.end());
  level.mu.assign(grid.mu.begin(), grid.mu.end());
  while (level.size.z % 2 == 0 && level.size.z > 7 && level.size.nodes() > 2000) {
    levels_.push_back(std::make_unique<Level>(level));
    level = coarser(level);
  }
  levels_.push_back(std::make_unique<Level>(level));
  coarsest_ = std::make_unique<Coarsest>(level);
}
Multigrid::~Multigrid() = default;

void Multigrid::cycle(std::size_t number) {
  Level& level = *levels_[number];
  if (number + 1 == levels_.size()) return coarsest_->solve(level.r, level.u);
  level.smooth(true);
  level.grid.apply(level.u, level.force);
  each_node(level.inverse.size(), [&](std::size_t n) {
    for (int i = 0; i < 3; ++i) level.force.of[i][n] = level.r.of[i][n] - level.force.of[i][n];
  });
  Level& below = *levels_[number + 1];
  restrict_to(level.grid.size, level.force, below.grid.size, below.r);
  cycle(number + 1);
  add_interpolated(below.grid.size, below.u, level.grid.size, level.u);
  level.smooth(false);
}

void Multigrid::apply(const Field<double>& r, Field<double>& out) {
  Level& top = *levels_.front();
  double largest = 0;  // single precision has a smaller range than double
  for (const auto& component : r.of)
    for (const Complex& value : component)
      largest = std::max({largest, std::abs(value.real()), std::abs(value.imag())});
  if (largest == 0) largest = 1;
  each_node(top.inverse.size(), [&](std::size_t n) {
    for (int i = 0; i < 3; ++i) top.r.of[i][n] = Single(r.of[i][n] / largest);
  });
  cycle(0);
  each_node(top.inverse.size(), [&](std::size_t n) {
    for (int i = 0; i < 3; ++i) out.of[i][n] = largest * Complex(top.u.of[i][n]);
  });
}

}  // namespace continuum
