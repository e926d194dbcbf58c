// SPDX-License-Identifier: GPL-3.0-or-later
// compression.cpp  Solves the uniaxial test by conjugate gradients for complex symmetric matrices (COCG), with a
// multigrid cycle as preconditioner.
#include "bench/continuum/compression.hpp"

#include <cmath>
#include <stdexcept>

#include "bench/continuum/multigrid.hpp"

namespace continuum {
namespace {

using Vector = Field<double>;

/// Returns Σ a·b without complex conjugation. Layers are summed one by one, so that the sum does not depend on the
/// number of threads.
Complex product(const Size& n, const Vector& a, const Vector& b) {
  const std::size_t layer = std::size_t(n.x + 1) * (n.y + 1);
  std::vector<Complex> sums(std::size_t(n.z) + 1);
#pragma omp parallel for
  for (int k = 0; k <= n.z; ++k)
    for (int i = 0; i < 3; ++i)
      for (std::size_t at = k * layer; at < (k + 1) * layer; ++at) sums[k] += a.of[i][at] * b.of[i][at];
  Complex out;
  for (const Complex& sum : sums) out += sum;
  return out;
}

double norm(const Vector& a) {
  double sum = 0;
  for (const auto& component : a.of)
    for (const Complex& value : component) sum += std::norm(value);
  return std::sqrt(sum);
}

/// Removes translations along x and y and the rotation about z, which no boundary holds.
void remove_rigid_motions(const Size& n, Vector& u) {
  const double nodes = double(n.nodes()), cx = n.x / 2.0, cy = n.y / 2.0;
  Complex mean_x, mean_y, turn;
  double inertia = 0;
  for (int k = 0; k <= n.z; ++k)
    for (int j = 0; j <= n.y; ++j)
      for (int i = 0; i <= n.x; ++i) {
        const std::size_t at = n.node(i, j, k);
        mean_x += u.of[0][at], mean_y += u.of[1][at];
        turn += (i - cx) * u.of[1][at] - (j - cy) * u.of[0][at];
        inertia += (i - cx) * (i - cx) + (j - cy) * (j - cy);
      }
  mean_x /= nodes, mean_y /= nodes, turn /= inertia;
#pragma omp parallel for
  for (int k = 0; k <= n.z; ++k)
    for (int j = 0; j <= n.y; ++j)
      for (int i = 0; i <= n.x; ++i) {
        const std::size_t at = n.node(i, j, k);
        u.of[0][at] -= mean_x - (j - cy) * turn;
        u.of[1][at] -= mean_y + (i - cx) * turn;
      }
}

/// Adds `factor`·b to a.
void add(Vector& a, Complex factor, const Vector& b) {
  for (int i = 0; i < 3; ++i) {
    const auto n = std::ptrdiff_t(a.of[i].size());
#pragma omp parallel for
    for (std::ptrdiff_t at = 0; at < n; ++at) a.of[i][at] += factor * b.of[i][at];
  }
}

/// Returns the mean lateral strain along one axis: the difference between the mean displacements of the two side faces
/// at the ends of this axis, divided by the width. `width`, `other`: elements along the axis and along the other
/// lateral axis.
Complex lateral_strain(const Size& n, const Vector& u, int axis, int width, int other) {
  Complex sum;
  double weights = 0;
  for (int k = 0; k <= n.z; ++k)
    for (int j = 0; j <= other; ++j) {
      const double weight = (k == 0 || k == n.z ? 0.5 : 1) * (j == 0 || j == other ? 0.5 : 1);
      const auto at = [&](int end) { return axis == 0 ? n.node(end, j, k) : n.node(j, end, k); };
      sum += weight * (u.of[axis][at(width)] - u.of[axis][at(0)]);
      weights += weight;
    }
  return sum / (weights * width);
}

}  // namespace

Compression compress(const Grid<double>& grid, int x, int y, double tolerance) {
  const Size n = grid.size;
  Multigrid multigrid(grid);
  Vector u(n.nodes()), r(n.nodes()), z(n.nodes()), p(n.nodes()), q(n.nodes());
  for (int k = 0; k <= n.z; ++k)  // a strain of 1 along z alone
    for (int j = 0; j <= n.y; ++j)
      for (int i = 0; i <= n.x; ++i) u.of[2][n.node(i, j, k)] = k;
  grid.apply(u, r);
  for (auto& component : r.of)
    for (auto& value : component) value = -value;
  const double first = norm(r);
  Compression out;
  Complex rho_before = 1;
  for (out.residual = first > 0 ? 1 : 0; out.residual > tolerance; ++out.iterations) {
    if (out.iterations == 500) throw std::runtime_error("500 iterations: residual " + std::to_string(out.residual));
    multigrid.apply(r, z);
    remove_rigid_motions(n, z);
    const Complex rho = product(n, r, z);
    const Complex beta = out.iterations == 0 ? 0 : rho / rho_before;
    for (int i = 0; i < 3; ++i)
      for (std::size_t at = 0; at < n.nodes(); ++at) p.of[i][at] = z.of[i][at] + beta * p.of[i][at];
    grid.apply(p, q);
    const Complex alpha = rho / product(n, p, q);
    add(u, alpha, p), add(r, -alpha, q);
    rho_before = rho;
    out.residual = norm(r) / first;
  }
  grid.apply(u, q, true);
  out.modulus = product(n, u, q) / (double(x) * y * n.z);  // twice the energy over volume and strain²
  out.poisson = -(lateral_strain(n, u, 0, x, y) + lateral_strain(n, u, 1, y, x)) / 2.0;
  return out;
}

}  // namespace continuum
