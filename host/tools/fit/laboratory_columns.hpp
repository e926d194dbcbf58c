// SPDX-License-Identifier: GPL-3.0-or-later
/// \file laboratory_columns.hpp  Recognises the names of the columns of measured moduli, and the units that these names
/// contain.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace macadam::fitting {

/// The quantity in a column.
enum class Quantity {
  frequency,
  e_star,
  g_star,
  e_prime,
  e_double_prime,
  g_prime,
  g_double_prime,
  phase,
  temperature,
  e_star_std,
  g_star_std,
  phase_std
};

/// A known column. Value in Hz, Pa, degrees or degrees Celsius = factor · cell + offset.
struct LaboratoryColumn {
  std::string name;
  Quantity quantity;
  std::string unit;  ///< the unit as messages write it; empty: the unit of the modulus or phase column
  double factor = 1, offset = 0;
};

/// Returns all known columns, for example each modulus in Pa, kPa, MPa and GPa.
const std::vector<LaboratoryColumn>& laboratory_columns();

/// Returns the column with a name, upper or lower case; nullptr if there is none.
const LaboratoryColumn* find_column(std::string_view name);

/// Returns a cell of a row of units as the ending of a column's name: "[MPa]" gives mpa, "°C" gives c, "rad/s" gives
/// rad_s.
std::string unit_suffix(std::string_view cell);

/// Returns the expected range as text for a message, with its unit, if `value` [SI] is impossible for the quantity of
/// the column. Returns an empty text if the value is possible.
std::string expected_of(const LaboratoryColumn& column, double value);

}  // namespace macadam::fitting
