// SPDX-License-Identifier: GPL-3.0-or-later
// multigrid.cpp  The levels of a multigrid cycle: smoothing, restriction and interpolation, and the coarsest solution.
#include "host/tools/ct/continuum/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "host/tools/ct/continuum/coarsest_grid.hpp"
#include "host/tools/ct/continuum/transfer.hpp"

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
  coarsest_ = std::make_unique<CoarsestGrid>(level);
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
