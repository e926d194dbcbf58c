// SPDX-License-Identifier: GPL-3.0-or-later
/// \file units.hpp  Parses numbers with units: "12.5 mm", "35 GPa", "5 %". A quantity accepts units of its own
/// dimension only.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace macadam::scene {

/// A unit that equals `factor`·10^`exponent` SI units.
struct Unit {
  std::string_view name;
  int exponent;
  double factor = 1;
};

/// A physical dimension: its name, and the units in which it may be given, the SI unit first.
struct Quantity {
  const char* name;
  std::span<const Unit> units;
};

extern const Quantity length;                  ///< [m]
extern const Quantity modulus;                 ///< [Pa]
extern const Quantity viscosity;               ///< [Pa·s]
extern const Quantity density;                 ///< [kg/m³]
extern const Quantity mass;                    ///< [kg]
extern const Quantity frequency;               ///< [Hz]
extern const Quantity duration;                ///< [s]
extern const Quantity rate;                    ///< [1/s]
extern const Quantity speed;                   ///< [m/s]
extern const Quantity temperature;             ///< [°C]
extern const Quantity temperature_difference;  ///< [K]
extern const Quantity warming_rate;            ///< [K/s]
extern const Quantity expansion;               ///< [1/K]
extern const Quantity molar_energy;            ///< [J/mol]
extern const Quantity fracture_energy;         ///< [J/m²]
extern const Quantity ratio;                   ///< [1]; text must be a percentage

/// Describes, for messages, how a value of this quantity may be written: `a number in Pa, or text with one of: Pa, kPa,
/// …`.
std::string accepted(const Quantity& quantity);

/// Returns the SI value of `text`, a decimal number followed by a unit of the quantity; empty if the text is anything
/// else. The power of ten is applied to the decimal text, so that "9.5 mm" is the same double as 0.0095.
std::optional<double> parse(std::string_view text, const Quantity& quantity);

}  // namespace macadam::scene
