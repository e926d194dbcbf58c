// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grid.hpp  Defines a grid of cubic elements with complex moduli, and the product of its stiffness with a
/// vector.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "bench/continuum/element.hpp"

namespace continuum {

using Complex = std::complex<double>;

/// Number of elements along the axes.
struct Size {
  int x = 0, y = 0, z = 0;
  std::size_t elements() const { return std::size_t(x) * y * z; }
  std::size_t nodes() const { return std::size_t(x + 1) * (y + 1) * (z + 1); }
  std::size_t element(int i, int j, int k) const { return (std::size_t(k) * y + j) * x + i; }
  std::size_t node(int i, int j, int k) const { return (std::size_t(k) * (y + 1) + j) * (x + 1) + i; }
};

/// A displacement or force for each node: one array per component. T: float or double.
template <class T>
struct Field {
  std::vector<std::complex<T>> of[3];
  explicit Field(std::size_t nodes = 0) {
    for (auto& component : of) component.assign(nodes, {});
  }
};

/// Cubic elements with Lamé's constants, each divided by a reference modulus. In elements without material the
/// constants are zero. The bottom and top faces cannot move along z.
template <class T>
struct Grid {
  Size size;
  std::vector<std::complex<T>> lambda, mu;  ///< [element]

  /// Computes f = K·u for edge length 1. At nodes of the bottom and top faces, the z component of f is the force of the
  /// face on the node if `faces` is true; otherwise it is set to zero.
  void apply(const Field<T>& u, Field<T>& f, bool faces = false) const;
  /// Returns the inverses of the 3 × 3 blocks on the diagonal, row by row; zero for nodes without material.
  std::vector<std::array<std::complex<T>, 9>> inverse_diagonal() const;
};

/// Returns the grid with edges twice as long. An element has twice the mean of the constants of the eight elements that
/// it replaces, because its edge is twice as long.
template <class T>
Grid<T> coarser(const Grid<T>& fine);

/// Adds the coarse displacement, interpolated, to the fine one.
template <class T>
void add_interpolated(const Size& coarse, const Field<T>& from, const Size& fine, Field<T>& to);
/// Sums fine forces into the coarse nodes: the transpose of add_interpolated().
template <class T>
void restrict_to(const Size& fine, const Field<T>& from, const Size& coarse, Field<T>& to);

}  // namespace continuum
