// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grid.hpp  Defines a grid of elements with complex moduli, and the product of its stiffness with a vector.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace macadam::continuum {

using Complex = std::complex<double>;

/// Entries behind the last one of an array, so that the largest packet (64 bytes, packet.hpp) can be read from any
/// entry. They stay zero. The number does not depend on the processor, because files that are compiled for different
/// processors share these arrays.
constexpr std::size_t padding = 64 / sizeof(std::complex<float>);

/// Number of elements along the axes.
struct Size {
  int x = 0, y = 0, z = 0;
  std::size_t elements() const { return std::size_t(x) * y * z; }
  std::size_t nodes() const { return layer() * (z + 1); }
  std::size_t layer() const { return std::size_t(x + 1) * (y + 1); }  ///< nodes of equal z
  std::size_t element(int i, int j, int k) const { return (std::size_t(k) * y + j) * x + i; }
  std::size_t node(int i, int j, int k) const { return (std::size_t(k) * (y + 1) + j) * (x + 1) + i; }
  /// Returns whether the grid is so large that several threads are faster than one.
  bool is_large() const { return nodes() > 20000; }
  bool operator==(const Size&) const = default;
};

/// A displacement or force for each node: one array per component, with `padding`. T: float or double.
template <class T>
struct Field {
  std::vector<std::complex<T>> of[3];
  explicit Field(std::size_t nodes = 0) {
    for (auto& component : of) component.assign(nodes + padding, {});
  }
};

/// Elements with Lamé's constants [Pa], divided by a reference modulus. Elements without material have zeros. The
/// bottom and top faces cannot move along z.
template <class T>
struct Grid {
  Size size;
  std::vector<std::complex<T>> lambda, mu;  ///< [element], with `padding`
  std::vector<double> height;               ///< of each layer of elements, divided by the edges along x and y

  /// Makes a grid of cubes without material.
  explicit Grid(const Size& of = {})
      : size(of), lambda(of.elements() + padding), mu(of.elements() + padding), height(std::size_t(of.z), 1.0) {}
  /// Computes f = K·u for edge length 1. `u` must be zero where the faces hold it; f is set to zero there, and at the
  /// end holds the forces of the faces if `faces` is true.
  void apply(const Field<T>& u, Field<T>& f, bool faces = false) const;
  /// Returns the inverses of the diagonal elements of K; zero for nodes without material, and for held components.
  Field<T> inverse_diagonal() const;
};

/// Sets the components to zero that the faces hold.
template <class T>
void clear_held(const Size& size, Field<T>& f);

}  // namespace macadam::continuum
