// SPDX-License-Identifier: GPL-3.0-or-later
/// \file given_arrays.hpp  Arrays that Python hands over: checked, converted and copied.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam::python {

namespace nb = nanobind;

inline bool is_any_object(PyObject*) { return true; }

/// An argument that NumPy can read as an array: an array, a list, a column of a table. Functions
/// convert it themselves, so that a wrong shape is an InputError that names the argument, not a TypeError with a C++
/// signature.
class ArrayLike : public nb::object {
  NB_OBJECT_DEFAULT(ArrayLike, nb::object, "numpy.typing.ArrayLike", is_any_object)
};

/// Returns numbers of shape (n,). rows: the n that is expected; without it any.
/// \throws InputError that names the argument, the shape or kind found and the shape expected.
std::vector<double> numbers(const ArrayLike& given, const std::string& name, std::optional<std::size_t> rows = {});

/// Returns whole numbers of 32 bits, shape (n,). \throws InputError as numbers(), also for a fraction.
std::vector<std::int32_t> whole_numbers(const ArrayLike& given, const std::string& name);

/// Returns vectors, shape (n, 3). \throws InputError as numbers().
std::vector<Vec3d> vectors(const ArrayLike& given, const std::string& name, std::optional<std::size_t> rows = {});

/// Returns rows of three whole numbers of 32 bits, shape (n, 3). \throws InputError as whole_numbers().
std::vector<std::array<std::int32_t, 3>> whole_triples(const ArrayLike& given, const std::string& name);

/// Returns the numbers as a NumPy array of any shape, of the kind that they have: bool, int, uint or float.
/// \throws InputError for text, rows of different lengths and the like; `expected` ends its message.
nb::object number_array(nb::handle given, const std::string& name, const std::string& expected);

}  // namespace macadam::python
