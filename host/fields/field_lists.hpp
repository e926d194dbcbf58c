// SPDX-License-Identifier: GPL-3.0-or-later
/// \file field_lists.hpp  Converts lists in double precision to arrays of a field file, which are in single precision.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "macadam/fields.hpp"

namespace macadam {

/// Returns an array with one number per entry of `list`.
inline FieldArray scalars(std::string name, std::string unit, const std::vector<double>& list) {
  return {std::move(name), std::move(unit), 1, std::vector<float>(list.begin(), list.end())};
}

/// Returns an array with `components` numbers per entry; of(entry, component) returns each number.
template <class F>
FieldArray tuples(std::string name, std::string unit, std::size_t entries, int components, F&& of) {
  std::vector<float> values(entries * static_cast<std::size_t>(components));
  auto value = values.begin();
  for (std::size_t i = 0; i < entries; ++i) {
    for (int k = 0; k < components; ++k) *value++ = static_cast<float>(of(i, k));
  }
  return {std::move(name), std::move(unit), components, std::move(values)};
}

/// Returns an array with three numbers (x, y, z) per entry of `list`.
inline FieldArray vectors(std::string name, std::string unit, const std::vector<Vec3d>& list) {
  return tuples(std::move(name), std::move(unit), list.size(), 3, [&](std::size_t i, int k) {
    const Vec3d& v = list[i];
    return k == 0 ? v.x : k == 1 ? v.y : v.z;
  });
}

/// Returns whether the law of a contact has a crack.
inline bool has_crack(const FactsTable& laws, const Contact& contact) {
  const auto& law = laws[static_cast<std::size_t>(contact.pair)];
  return law && law->cracks;
}

/// Units of the relative displacements of a contact: opening, slopes along s and t, slips along s and t, twist.
inline constexpr const char* relative_unit = "m, rad, rad, m, m, rad";

}  // namespace macadam
