// SPDX-License-Identifier: GPL-3.0-or-later
/// \file given_arrays.hpp  Checks, converts and copies arrays that are arguments of a Python call.
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

/// An argument that NumPy can read as an array: an array, a list, a column of a table. The functions below convert it,
/// so that a wrong shape raises an InputError that names the argument. If the argument had an array type of nanobind, a
/// wrong shape would raise a TypeError that shows the C++ signature.
class ArrayLike : public nb::object {
  NB_OBJECT_DEFAULT(ArrayLike, nb::object, "numpy.typing.ArrayLike", is_any_object)
};

/// Returns numbers of shape (n,). rows: the expected n; if it is not given, any n is accepted. \throws InputError that
/// names the argument, the shape or kind found and the shape expected.
std::vector<double> numbers(const ArrayLike& given, const std::string& name, std::optional<std::size_t> rows = {});

/// Returns whole numbers of 32 bits, shape (n,). \throws InputError like numbers(), and for a number that is not whole.
std::vector<std::int32_t> whole_numbers(const ArrayLike& given, const std::string& name);

/// Returns vectors, shape (n, 3). rows: as in numbers(). \throws InputError as numbers().
std::vector<Vec3d> vectors(const ArrayLike& given, const std::string& name, std::optional<std::size_t> rows = {});

/// Returns rows of three whole numbers of 32 bits, shape (n, 3). \throws InputError as whole_numbers().
std::vector<std::array<std::int32_t, 3>> whole_triples(const ArrayLike& given, const std::string& name);

/// Returns the numbers as a NumPy array of any shape. The kind of number is kept: bool, int, uint or float. \throws
/// InputError for anything that is not an array of numbers, such as text or rows of different lengths. expected: the
/// words of the message that say what was expected.
nb::object number_array(nb::handle given, const std::string& name, const std::string& expected);

}  // namespace macadam::python
