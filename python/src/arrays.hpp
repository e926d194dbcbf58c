// SPDX-License-Identifier: GPL-3.0-or-later
/// \file arrays.hpp  Gives the library's vectors to Python as NumPy arrays, as views without a copy or as arrays that
/// own their numbers.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "macadam/error.hpp"
#include "macadam/numeric.hpp"

namespace macadam::python {

namespace nb = nanobind;

/// A read-only NumPy array that refers to the library's memory without a copy. By default nanobind binds properties
/// with reference_internal, so the array keeps alive the object that owns the memory.
template <class T>
using View = nb::ndarray<nb::numpy, const T>;

/// Returns a view of the numbers from `data` on. strides: in elements of T, not bytes; row-major if they are not given.
template <class T>
View<T> view(const T* data, std::initializer_list<std::size_t> shape,
             std::initializer_list<std::int64_t> strides = {}) {
  return View<T>(data, shape.size(), shape.begin(), nb::handle(), strides.size() > 0 ? strides.begin() : nullptr);
}

/// Returns a view of shape (n,).
template <class T>
View<T> view(const std::vector<T>& values) {
  return view(values.data(), {values.size()});
}

/// Returns a view of shape (n, 3).
inline View<double> view(const std::vector<Vec3d>& values) {
  static_assert(sizeof(Vec3d) == 3 * sizeof(double));
  return view(reinterpret_cast<const double*>(values.data()), {values.size(), 3});
}

/// Returns a strided view, shape (n,), of one member of type T of every entry. entry: returns the address of the member
/// in an Owner.
template <class T, class Owner, class Entry>
View<T> member(const std::vector<Owner>& entries, const Entry& entry) {
  static_assert(sizeof(Owner) % sizeof(T) == 0);
  static const Owner none{};
  const T* first = entry(entries.empty() ? none : entries.front());
  return view(first, {entries.size()}, {static_cast<std::int64_t>(sizeof(Owner) / sizeof(T))});
}
/// Returns a strided view, shape (n, 3), of one Vec3d member of every entry. entry: returns a reference to the member
/// in an Owner.
template <class Owner, class Entry>
View<double> member3(const std::vector<Owner>& entries, const Entry& entry) {
  static_assert(sizeof(Owner) % sizeof(double) == 0);
  static const Owner none{};
  const double* first = &entry(entries.empty() ? none : entries.front()).x;
  return view(first, {entries.size(), 3}, {static_cast<std::int64_t>(sizeof(Owner) / sizeof(double)), 1});
}

/// Returns an array that owns the given numbers and that Python may change. shape: (n,) if it is not given.
template <class T>
nb::ndarray<nb::numpy, T> owned(std::vector<T> values, std::vector<std::size_t> shape = {}) {
  auto* kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  if (shape.empty()) shape = {kept->size()};
  return nb::ndarray<nb::numpy, T>(kept->data(), shape.size(), shape.data(), owner);
}

inline nb::tuple triple(const Vec3d& v) { return nb::make_tuple(v.x, v.y, v.z); }

}  // namespace macadam::python
