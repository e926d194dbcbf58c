// SPDX-License-Identifier: GPL-3.0-or-later
// compression.cpp  Conjugate gradients for complex symmetric matrices (COCG), with a multigrid cycle as preconditioner.
#include "host/tools/ct/continuum/compression.hpp"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "host/tools/ct/continuum/connection.hpp"
#include "host/tools/ct/continuum/multigrid.hpp"
#include "macadam/error.hpp"

namespace macadam::continuum {
namespace {

using Vector = Field<double>;

constexpr int most_iterations = 500;  ///< the largest number in bench/results/continuum.csv is 27

/// Calls f(component, first node) for every layer of nodes, in parallel, and returns the sum of the results. Layers are
/// summed in their order, so that the sum does not depend on the number of threads.
template <class Sum, class F>
Sum sum_of_layers(const Size& n, F&& f) {
  std::vector<Sum> sums(std::size_t(n.z) + 1);
#pragma omp parallel for schedule(static) if (n.is_large())
  for (int k = 0; k <= n.z; ++k)
    for (int i = 0; i < 3; ++i) sums[std::size_t(k)] += f(i, n.layer() * std::size_t(k));
  return std::accumulate(sums.begin(), sums.end(), Sum{});
}

/// Returns the sum of products without conjugation.
Complex product(const Size& n, const Vector& a, const Vector& b) {
  return sum_of_layers<Complex>(n, [&](int i, std::size_t begin) {
    Complex sum;
    for (std::size_t at = begin; at < begin + n.layer(); ++at) sum += a.of[i][at] * b.of[i][at];
    return sum;
  });
}

double norm(const Size& n, const Vector& a) {
  return std::sqrt(sum_of_layers<double>(n, [&](int i, std::size_t begin) {
    double sum = 0;
    for (std::size_t at = begin; at < begin + n.layer(); ++at) sum += std::norm(a.of[i][at]);
    return sum;
  }));
}

/// Removes translations along x and y and the rotation about z, which no boundary holds.
void remove_rigid_motions(const Size& n, Vector& u) {
  struct Motion {
    Complex x, y, turn;
    Motion operator+(const Motion& b) const { return {x + b.x, y + b.y, turn + b.turn}; }
  };
  const double cx = n.x / 2.0, cy = n.y / 2.0;
  std::vector<Motion> layers(std::size_t(n.z) + 1);
#pragma omp parallel for schedule(static) if (n.is_large())
  for (int k = 0; k <= n.z; ++k) {
    Motion sum{};
    for (int j = 0; j <= n.y; ++j)
      for (int i = 0; i <= n.x; ++i) {
        const std::size_t at = n.node(i, j, k);
        sum.x += u.of[0][at], sum.y += u.of[1][at];
        sum.turn += (i - cx) * u.of[1][at] - (j - cy) * u.of[0][at];
      }
    layers[std::size_t(k)] = sum;
  }
  double inertia = 0;  // of one layer
  for (int j = 0; j <= n.y; ++j)
    for (int i = 0; i <= n.x; ++i) inertia += (i - cx) * (i - cx) + (j - cy) * (j - cy);
  Motion mean = std::accumulate(layers.begin(), layers.end(), Motion{});
  mean.x /= double(n.nodes()), mean.y /= double(n.nodes()), mean.turn /= inertia * (n.z + 1);
#pragma omp parallel for schedule(static) if (n.is_large())
  for (int k = 0; k <= n.z; ++k)
    for (int j = 0; j <= n.y; ++j)
      for (int i = 0; i <= n.x; ++i) {
        const std::size_t at = n.node(i, j, k);
        u.of[0][at] -= mean.x - (j - cy) * mean.turn;
        u.of[1][at] -= mean.y + (i - cx) * mean.turn;
      }
}

/// Returns the mean lateral strain between the free sides along one axis (0 or 1): the sum over rows of elements of
/// the elongation between the first and the last element with material, over the sum of the rows' lengths.
Complex lateral_strain(const Grid<double>& grid, const Vector& u, int axis) {
  const Size& n = grid.size;
  Complex elongation;
  double length = 0;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < (axis == 0 ? n.y : n.x); ++j) {
      int first = -1, last = -1;
      for (int i = 0; i < (axis == 0 ? n.x : n.y); ++i)
        if (grid.mu[axis == 0 ? n.element(i, j, k) : n.element(j, i, k)] != Complex{})
          first = first < 0 ? i : first, last = i + 1;
      if (first < 0) continue;
      for (int c = 0; c < 4; ++c) {
        const int jj = j + (c & 1), kk = k + (c >> 1);
        const auto at = [&](int i) { return axis == 0 ? n.node(i, jj, kk) : n.node(jj, i, kk); };
        elongation += (u.of[axis][at(last)] - u.of[axis][at(first)]) / 4.0;
      }
      length += last - first;
    }
  return elongation / length;
}

/// \throws RunError if a result is not a finite number.
void require_numbers(double result) {
  if (!std::isfinite(result)) throw RunError("finite elements: found a solution that is not a number");
}

/// Returns the displacement of a strain of 1 along z alone.
Vector axial_strain(const Size& n) {
  Vector u(n.nodes());
  for (int k = 0; k <= n.z; ++k)
    std::fill_n(u.of[2].begin() + std::ptrdiff_t(n.layer() * std::size_t(k)), n.layer(), double(k));
  return u;
}

}  // namespace

Compression compress(const Grid<double>& grid, double area, double tolerance, Vector& u, const Watch& watch) {
  const Size n = grid.size;
  Vector r(n.nodes()), z(n.nodes()), p(n.nodes()), q(n.nodes());
  const bool guessed = u.of[0].size() == r.of[0].size();
  if (!guessed) u = axial_strain(n);
  grid.apply(guessed ? axial_strain(n) : u, r);
  const double first = norm(n, r);
  require_numbers(first);
  if (guessed) grid.apply(u, r);
  for (auto& component : r.of)
    for (auto& value : component) value = -value;
  Multigrid multigrid(grid);
  Compression out;
  Complex rho_before = 1;
  for (out.residual = first > 0 ? norm(n, r) / first : 0; out.residual > tolerance; ++out.iterations) {
    if (out.iterations == most_iterations)
      throw RunError(fmt::format("finite elements: {} iterations leave a residual of {:.1e}, expected {:.1e}",
                                 most_iterations, out.residual, tolerance));
    if (watch) watch(out.residual);
    multigrid.apply(r, z);
    remove_rigid_motions(n, z);
    const Complex rho = product(n, r, z);
    const Complex beta = out.iterations == 0 ? 0 : rho / rho_before;
    sum_of_layers<double>(n, [&](int i, std::size_t begin) {
      for (std::size_t at = begin; at < begin + n.layer(); ++at) p.of[i][at] = z.of[i][at] + beta * p.of[i][at];
      return 0.0;
    });
    grid.apply(p, q);
    const Complex alpha = rho / product(n, p, q);
    out.residual = std::sqrt(sum_of_layers<double>(n,
                                                   [&](int i, std::size_t begin) {
                                                     double sum = 0;
                                                     for (std::size_t at = begin; at < begin + n.layer(); ++at) {
                                                       u.of[i][at] += alpha * p.of[i][at];
                                                       sum += std::norm(r.of[i][at] -= alpha * q.of[i][at]);
                                                     }
                                                     return sum;
                                                   })) /
                   first;
    rho_before = rho;
  }
  grid.apply(u, q, true);
  // a residual that is not a number ends the loop too
  out.modulus = product(n, u, q) / (area * n.z);  // twice the energy over volume and strain²
  out.poisson = -(lateral_strain(grid, u, 0) + lateral_strain(grid, u, 1)) / 2.0;
  require_numbers(out.residual), require_numbers(std::abs(out.modulus)), require_numbers(std::abs(out.poisson));
  return out;
}

std::size_t remove_loose_pieces(Grid<double>& grid) {
  std::vector<unsigned char> marks(grid.size.elements());
  for (std::size_t e = 0; e < marks.size(); ++e) marks[e] = grid.mu[e] != Complex{} ? Connection::solid : 0;
  const Connection connection = find_connection(grid.size, std::move(marks));
  if (connection.of_both == 0)
    throw InputError("the specimen", 0, "connection of bottom and top", "none",
                     "material that connects both ends of the specimen");
  for (std::size_t e = 0; e < grid.size.elements(); ++e)
    if (!connection.spans(e)) grid.mu[e] = grid.lambda[e] = 0;
  return connection.count - connection.of_both;
}

}  // namespace macadam::continuum
