// SPDX-License-Identifier: GPL-3.0-or-later
// multigrid.cpp  The levels of a multigrid cycle: smoothing, restriction and interpolation, and the coarsest solution.
#include "host/tools/ct/continuum/multigrid.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "host/tools/ct/continuum/element.hpp"
#include "host/tools/ct/continuum/transfer.hpp"
#include "macadam/error.hpp"

namespace macadam::continuum {
namespace {

using Single = std::complex<float>;

/// Degree of the smoother, and the part of the spectrum that it does not damp. With these values 41 balls at voxels of
/// 0.5 mm (ratio of moduli 14) need 12 to 13 iterations. Other values were not tried.
constexpr int smoothing_degree = 3;
constexpr float smoothed_part = 0.12F;

/// Calls f(number, first node) for every layer of nodes, in parallel.
template <class F>
void each_layer(const Size& size, F&& f) {
#pragma omp parallel for schedule(static) if (size.is_large())
  for (int k = 0; k <= size.z; ++k) f(k, size.layer() * std::size_t(k));
}

}  // namespace

struct Multigrid::Level {
  Grid<float> grid;
  Field<float> inverse;  ///< of the diagonal
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

  /// Returns 1.1 times the estimate of the largest eigenvalue by 10 steps of the power method.
  float estimate() {
    const std::size_t layer = grid.size.layer();
    std::uint32_t state = 1;
    for (auto& component : u.of)
      for (std::size_t n = 0; n < grid.size.nodes(); ++n)
        component[n] = float((state = state * 1664525U + 1013904223U) >> 8) / float(1 << 24) - 0.5F;
    double norm = 1;
    std::vector<double> sums(std::size_t(grid.size.z) + 1);
    for (int step = 0; step < 10; ++step) {
      grid.apply(u, force);
      const auto before = float(1 / norm);
      std::fill(sums.begin(), sums.end(), 0.0);
      each_layer(grid.size, [&](int k, std::size_t begin) {
        for (int i = 0; i < 3; ++i)
          for (std::size_t n = begin; n < begin + layer; ++n)
            sums[std::size_t(k)] += std::norm(u.of[i][n] = before * (inverse.of[i][n] * force.of[i][n]));
      });
      norm = std::sqrt(std::accumulate(sums.begin(), sums.end(), 0.0));
    }
    return float(1.1 * norm);
  }

  /// Improves u for the right-hand side r by a Chebyshev polynomial. `zero`: u counts as zero at the start.
  void smooth(bool zero) {
    const float low = smoothed_part * largest, centre = (largest + low) / 2, half = (largest - low) / 2;
    float rho = half / centre;
    for (int step = 0; step < smoothing_degree; ++step) {
      const bool first = step == 0;
      if (!(first && zero)) grid.apply(u, force);
      const float next = first ? rho : 1 / (2 * centre / half - rho);
      const float keep = first ? 0 : next * rho, gain = first ? 1 / centre : 2 * next / half;
      each_layer(grid.size, [&](int, std::size_t begin) {
        for (int i = 0; i < 3; ++i) {
          Single *const uu = &u.of[i][begin], *const cc = &change.of[i][begin];
          const Single *const rr = &r.of[i][begin], *const ff = &force.of[i][begin], *const dd = &inverse.of[i][begin];
          const std::size_t count = grid.size.layer();
          if (first && zero)
            for (std::size_t n = 0; n < count; ++n) uu[n] = cc[n] = gain * (dd[n] * rr[n]);
          else if (first)
            for (std::size_t n = 0; n < count; ++n) uu[n] += cc[n] = gain * (dd[n] * (rr[n] - ff[n]));
          else
            for (std::size_t n = 0; n < count; ++n) uu[n] += cc[n] = keep * cc[n] + gain * (dd[n] * (rr[n] - ff[n]));
        }
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
    factors.compute(matrix);
    if (factors.info() != Eigen::Success)
      throw RunError("finite elements: the matrix of the coarsest grid cannot be factorised");
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
  Grid<float> level(grid.size);
  level.height = grid.height;
  std::copy(grid.lambda.begin(), grid.lambda.end(), level.lambda.begin());
  std::copy(grid.mu.begin(), grid.mu.end(), level.mu.begin());
  while (level.size.z > 3 && level.size.nodes() > 1000) {
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
  const Size& size = level.grid.size;
  level.smooth(true);
  level.grid.apply(level.u, level.force);
  each_layer(size, [&](int, std::size_t begin) {
    for (int i = 0; i < 3; ++i)
      for (std::size_t n = begin; n < begin + size.layer(); ++n)
        level.force.of[i][n] = level.r.of[i][n] - level.force.of[i][n];
  });
  Level& below = *levels_[number + 1];
  restrict_to(level.grid, level.force, below.grid.size, below.r);
  cycle(number + 1);
  add_interpolated(below.grid.size, below.u, level.grid, level.u);
  level.smooth(false);
}

void Multigrid::apply(const Field<double>& r, Field<double>& out) {
  Level& top = *levels_.front();
  const Size& size = top.grid.size;
  std::vector<double> layers(std::size_t(size.z) + 1);  // single precision has a smaller range than double
  each_layer(size, [&](int k, std::size_t begin) {
    for (int i = 0; i < 3; ++i)
      for (std::size_t n = begin; n < begin + size.layer(); ++n)
        layers[k] = std::max({layers[k], std::abs(r.of[i][n].real()), std::abs(r.of[i][n].imag())});
  });
  double largest = *std::max_element(layers.begin(), layers.end());
  if (largest == 0) largest = 1;
  each_layer(size, [&](int, std::size_t begin) {
    for (int i = 0; i < 3; ++i)
      for (std::size_t n = begin; n < begin + size.layer(); ++n) top.r.of[i][n] = Single(r.of[i][n] / largest);
  });
  cycle(0);
  each_layer(size, [&](int, std::size_t begin) {
    for (int i = 0; i < 3; ++i)
      for (std::size_t n = begin; n < begin + size.layer(); ++n) out.of[i][n] = largest * Complex(top.u.of[i][n]);
  });
}

}  // namespace macadam::continuum
