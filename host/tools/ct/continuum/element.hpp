// SPDX-License-Identifier: GPL-3.0-or-later
/// \file element.hpp  Computes the stiffness of a finite element with eight nodes: as a matrix, and as a product with
/// packets of elements.
#pragma once

#include <array>
#include <cmath>

#include "host/tools/ct/continuum/packet.hpp"

namespace macadam::continuum {

constexpr int corners = 8, dofs = 24;  ///< unknown 3 c + i: component i of corner c = x + 2 y + 4 z (x, y, z: 0 or 1)
using ElementMatrix = std::array<std::array<double, dofs>, dofs>;

/// The stiffness of an element with edges 1 × 1 × `height` is lambda·`lambda` + mu·`mu`, with Lamé's constants; for
/// edges h times as long it is h times as large. Computed with 2 × 2 × 2 Gauss points, which is exact for trilinear
/// displacements.
struct ElementStiffness {
  ElementMatrix lambda{}, mu{};

  explicit ElementStiffness(double height = 1) {
    const double gauss = 0.5 / std::sqrt(3.0), edges[3] = {1, 1, height};
    for (int point = 0; point < 8; ++point) {
      std::array<double, 3> at{};
      for (int i = 0; i < 3; ++i) at[i] = 0.5 + ((point >> i & 1) != 0 ? gauss : -gauss);
      double gradient[corners][3];  // of each corner's shape function
      for (int c = 0; c < corners; ++c)
        for (int i = 0; i < 3; ++i) {
          gradient[c][i] = ((c >> i & 1) != 0 ? 1 : -1) / edges[i];
          for (int j = 0; j < 3; ++j)
            if (j != i) gradient[c][i] *= (c >> j & 1) != 0 ? at[j] : 1 - at[j];
        }
      add(gradient, height / 8);
    }
  }

 private:
  void add(const double (&gradient)[corners][3], double volume) {
    for (int a = 0; a < dofs; ++a)
      for (int b = 0; b < dofs; ++b) {
        const double *ga = gradient[a / 3], *gb = gradient[b / 3];
        const int i = a % 3, j = b % 3;
        const double dot = ga[0] * gb[0] + ga[1] * gb[1] + ga[2] * gb[2];
        lambda[a][b] += volume * ga[i] * gb[j];
        mu[a][b] += volume * ((i == j ? dot : 0.0) + ga[j] * gb[i]);
      }
  }
};

/// Replaces the values at the eight corners by the sums with the signs of the monomials 1, x, y, xy, z, xz, yz, xyz
/// (index: bit 0 x, bit 1 y, bit 2 z), where x, y and z are −1 or +1 at the corners.
template <class V>
inline void sum_with_signs(V (&a)[corners]) {
  for (int bit = 1; bit < corners; bit *= 2)
    for (int c = 0; c < corners; ++c)
      if ((c & bit) == 0) {
        const V low = a[c], high = a[c | bit];
        a[c] = low + high, a[c | bit] = high - low;
      }
}

/// Evaluates a sum of the monomials at the eight corners: the transpose of sum_with_signs().
template <class V>
inline void evaluate_at_corners(V (&a)[corners]) {
  for (int bit = 1; bit < corners; bit *= 2)
    for (int c = 0; c < corners; ++c)
      if ((c & bit) == 0) {
        const V even = a[c], odd = a[c | bit];
        a[c] = even - odd, a[c | bit] = even + odd;
      }
}

/// Multiplies the stiffness of a packet of elements (edges 1 × 1 × height) with their displacements, in place. The
/// displacement is a polynomial, u = Σ a_m m(x, y, z) / 8 with the eight monomials of sum_with_signs(). Strains are
/// then polynomials whose terms are orthogonal: the mean of 1 is 1, of x² 1/3 and of x²y² 1/9. So the energy needs no
/// Gauss points and few products.
template <class T>
inline void multiply_stiffness(Packet<T> (&u)[3][corners], const PacketFactor<T>& lambda, const PacketFactor<T>& mu,
                               T height) {
  using V = Packet<T>;
  for (auto& component : u) sum_with_signs(component);
  const T d[3] = {2, 2, 2 / height};  // a derivative along axis i has the factor d[i]
  const T volume = height / 64, third = volume / 3, ninth = volume / 9;
  V f[3][corners];
  // normal strain along i and shear strains for the terms that no other component shares
  const auto axis = [&](int i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const int x = 1 << i, y = 1 << j, z = 1 << k;
    const T ii = d[i] * d[i], jj = d[j] * d[j], kk = d[k] * d[k];
    f[i][x] = (mu * u[i][x]) * (2 * ii * volume);
    f[i][x | y] = (mu * u[i][x | y]) * ((2 * ii + jj) * third);
    f[i][x | z] = (mu * u[i][x | z]) * ((2 * ii + kk) * third);
    f[i][7] = (mu * u[i][7]) * ((2 * ii + jj + kk) * ninth) + (lambda * u[i][7]) * (ii * ninth);
  };
  axis(0), axis(1), axis(2);
  // shear strain of axes i and j: constant term, and the term that is linear along the third axis
  const auto shear = [&](int i, int j, int k) {
    const int x = 1 << i, y = 1 << j, z = 1 << k;
    const V constant = mu * (u[i][y] * d[j] + u[j][x] * d[i]);
    const V linear = mu * (u[i][y | z] * d[j] + u[j][x | z] * d[i]);
    f[i][y] = constant * (d[j] * volume), f[j][x] = constant * (d[i] * volume);
    const auto add = [](V& to, bool first, const V& value) { to = first ? value : to + value; };
    // f[i][y|z] gets two terms: from the shear strains of (i, j) and of (i, k)
    add(f[i][y | z], k > j, linear * (d[j] * third));
    add(f[j][x | z], k > i, linear * (d[i] * third));
  };
  shear(0, 1, 2), shear(0, 2, 1), shear(1, 2, 0);
  // dilation: constant term, and the terms that are linear along one axis
  const V dilation = lambda * (u[0][1] * d[0] + u[1][2] * d[1] + u[2][4] * d[2]);
  for (int i = 0; i < 3; ++i) f[i][1 << i] = f[i][1 << i] + dilation * (d[i] * volume);
  const auto linear = [&](int i, int j, int k) {
    const int x = 1 << i, y = 1 << j, z = 1 << k;
    const V term = lambda * (u[j][x | y] * d[j] + u[k][x | z] * d[k]);
    f[j][x | y] = f[j][x | y] + term * (d[j] * third);
    f[k][x | z] = f[k][x | z] + term * (d[k] * third);
  };
  linear(0, 1, 2), linear(1, 2, 0), linear(2, 0, 1);
  for (int i = 0; i < 3; ++i) {
    f[i][0].w = typename V::Words{};
    evaluate_at_corners(f[i]);
    for (int c = 0; c < corners; ++c) u[i][c] = f[i][c];
  }
}

}  // namespace macadam::continuum
