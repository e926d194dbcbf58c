// SPDX-License-Identifier: GPL-3.0-or-later
/// \file laboratory_columns.hpp  Names of the columns of measured moduli, and the units in them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace macadam::fitting {

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

/// A column that is understood: value in SI (Hz, Pa, degrees, degrees Celsius) = factor · cell + offset.
struct LaboratoryColumn {
  std::string name;
  Quantity quantity;
  std::string unit;  ///< as messages have it; empty: that of the modulus or phase column
  double factor = 1, offset = 0;
};

/// All columns that are understood: each modulus in Pa, kPa, MPa and GPa, for example.
const std::vector<LaboratoryColumn>& laboratory_columns();

/// The column of a name, in any case; null where there is none.
const LaboratoryColumn* find_column(std::string_view name);

/// A cell of a row of units as the end of a column's name: "[MPa]" is mpa, "°C" is c, "rad/s" is rad_s.
std::string unit_suffix(std::string_view cell);

/// Why a value [SI] cannot be one of a quantity: what was expected, with the unit; empty where it can.
std::string expected_of(const LaboratoryColumn& column, double value);

}  // namespace macadam::fitting
