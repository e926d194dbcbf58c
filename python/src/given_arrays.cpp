// SPDX-License-Identifier: GPL-3.0-or-later
// given_arrays.cpp  Converts an argument with NumPy and checks the kind of its numbers and its shape.
#include "python/src/given_arrays.hpp"

#include <fmt/format.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "macadam/error.hpp"

namespace macadam::python {
namespace {

using Doubles = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

[[noreturn]] void refuse(const std::string& name, const std::string& found, const std::string& expected) {
  throw InputError(fmt::format("{}: found {}, expected {}", name, found, expected));
}

/// Returns a name for the contents of an array that holds no numbers. kind: NumPy's letter for the type of its
/// elements.
std::string contents(char kind) {
  switch (kind) {
    case 'U':
    case 'S':
    case 'T':
      return "text";
    case 'c':
      return "complex numbers";
    case 'M':
    case 'm':
      return "dates";
    default:
      return "objects";
  }
}

std::string shape_of(nb::handle array) { return nb::repr(array.attr("shape")).c_str(); }

/// Returns "numbers of shape (n, 3)", with the number of rows for n if a certain number is expected.
std::string expected_shape(std::size_t columns, std::optional<std::size_t> rows) {
  const std::string n = rows ? std::to_string(*rows) : "n";
  return "numbers of shape " + (columns == 1 ? "(" + n + ",)" : fmt::format("({}, {})", n, columns));
}

/// Returns the numbers of an array, row after row. The array must have shape (n,) or, if `columns` is above 1, (n,
/// columns).
std::vector<double> doubles(nb::handle given, const std::string& name, std::size_t columns,
                            std::optional<std::size_t> rows) {
  const std::string expected = expected_shape(columns, rows);
  const nb::object array = number_array(given, name, expected);
  const auto in = nb::cast<Doubles>(array.attr("astype")("float64", "C"));
  const bool fits = columns == 1 ? in.ndim() == 1 : in.ndim() == 2 && in.shape(1) == columns;
  if (!fits || (rows && in.shape(0) != *rows)) refuse(name, "numbers of shape " + shape_of(array), expected);
  return {in.data(), in.data() + in.size()};
}

/// Returns the value as a 32-bit integer. \throws InputError, naming the row, if it is not one.
std::int32_t to_int32(double value, const std::string& name, std::size_t row) {
  using Limits = std::numeric_limits<std::int32_t>;
  if (!(value >= Limits::min() && value <= Limits::max() && value == std::floor(value))) {
    refuse(name, fmt::format("{} in row {}", value, row), "whole numbers of 32 bits");
  }
  return static_cast<std::int32_t>(value);
}

}  // namespace

nb::object number_array(nb::handle given, const std::string& name, const std::string& expected) {
  nb::object array;
  try {
    const nb::module_ numpy = nb::module_::import_("numpy");
    array = numpy.attr("asarray")(given);
    const char kind = nb::cast<std::string>(array.attr("dtype").attr("kind")).front();
    if (std::string_view("biuf").find(kind) != std::string_view::npos) return array;
    if (kind != 'O') refuse(name, contents(kind), expected);
    // An array of objects is, for example, a column with missing values or a row of Python numbers.
    return numpy.attr("asarray")(array, "float64");
  } catch (const nb::python_error& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    refuse(name, array.is_valid() ? "objects that are not numbers" : "rows of different lengths", expected);
  }
}

std::vector<double> numbers(const ArrayLike& given, const std::string& name, std::optional<std::size_t> rows) {
  return doubles(given, name, 1, rows);
}

std::vector<std::int32_t> whole_numbers(const ArrayLike& given, const std::string& name) {
  std::vector<std::int32_t> out;
  for (const double value : doubles(given, name, 1, {})) out.push_back(to_int32(value, name, out.size()));
  return out;
}

std::vector<Vec3d> vectors(const ArrayLike& given, const std::string& name, std::optional<std::size_t> rows) {
  const std::vector<double> flat = doubles(given, name, 3, rows);
  std::vector<Vec3d> out;
  for (std::size_t i = 0; i < flat.size(); i += 3) out.push_back({flat[i], flat[i + 1], flat[i + 2]});
  return out;
}

std::vector<std::array<std::int32_t, 3>> whole_triples(const ArrayLike& given, const std::string& name) {
  const std::vector<double> flat = doubles(given, name, 3, {});
  std::vector<std::array<std::int32_t, 3>> out;
  for (std::size_t i = 0; i < flat.size(); i += 3) {
    const auto at = [&](std::size_t k) { return to_int32(flat[i + k], name, i / 3); };
    out.push_back({at(0), at(1), at(2)});
  }
  return out;
}

}  // namespace macadam::python
