// SPDX-License-Identifier: GPL-3.0-or-later
/// \file element.hpp  Computes the stiffness matrix of a cubic finite element with eight nodes.
#pragma once

#include <array>
#include <cmath>

namespace continuum {

constexpr int corners = 8, dofs = 24;  ///< unknown 3 c + i: component i of corner c = x + 2 y + 4 z (x, y, z: 0 or 1)
using ElementMatrix = std::array<std::array<double, dofs>, dofs>;

/// The stiffness of a cube with edge 1 is lambda·`lambda` + mu·`mu`, with Lamé's constants; a cube with edge h is h
/// times as stiff. Computed with 2 × 2 × 2 Gauss points, which is exact for trilinear displacements.
struct ElementStiffness {
  ElementMatrix lambda{}, mu{};

  ElementStiffness() {
    const double gauss = 0.5 / std::sqrt(3.0);
    for (int point = 0; point < 8; ++point) {
      std::array<double, 3> at{};
      for (int i = 0; i < 3; ++i) at[i] = 0.5 + ((point >> i & 1) != 0 ? gauss : -gauss);
      double gradient[corners][3];  // of each corner's shape function
      for (int c = 0; c < corners; ++c)
        for (int i = 0; i < 3; ++i) {
          gradient[c][i] = (c >> i & 1) != 0 ? 1 : -1;
          for (int j = 0; j < 3; ++j)
            if (j != i) gradient[c][i] *= (c >> j & 1) != 0 ? at[j] : 1 - at[j];
        }
      add(gradient);
    }
  }

 private:
  void add(const double (&gradient)[corners][3]) {
    for (int a = 0; a < dofs; ++a)
      for (int b = 0; b < dofs; ++b) {
        const double *ga = gradient[a / 3], *gb = gradient[b / 3];
        const int i = a % 3, j = b % 3;
        const double dot = ga[0] * gb[0] + ga[1] * gb[1] + ga[2] * gb[2];
        lambda[a][b] += ga[i] * gb[j] / 8;
        mu[a][b] += ((i == j ? dot : 0.0) + ga[j] * gb[i]) / 8;
      }
  }
};

}  // namespace continuum
