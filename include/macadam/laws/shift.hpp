// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shift.hpp  Defines time–temperature superposition, by which temperature changes the times of a law:
/// docs/model.md, section 23.
///
/// A thermorheologically simple law at temperature T and frequency f equals the law at its reference temperature and
/// frequency f·a_T. Every viscosity of the law is multiplied by a_T; its springs stay the same.
#pragma once

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "macadam/laws/values.hpp"

namespace macadam::laws {

/// Temperature has no effect.
struct NoShift {
  bool operator==(const NoShift&) const = default;
};

/// Williams, Landel and Ferry: log10 a_T = −C1·(T − T_r)/(C2 + T − T_r). Not defined for T ≤ T_r − C2.
struct Wlf {
  double C1 = 0, C2 = 0;             ///< [1], [K]
  double reference_temperature = 0;  ///< T_r [°C]
  bool operator==(const Wlf&) const = default;
};

/// Arrhenius: ln a_T = E_a/R·(1/T − 1/T_r), temperatures in K.
struct Arrhenius {
  double activation_energy = 0;      ///< E_a [J/mol]
  double reference_temperature = 0;  ///< T_r [°C]
  bool operator==(const Arrhenius&) const = default;
};

/// log10 a_T at given temperatures, linear in between; not defined outside the range of the temperatures.
struct ShiftTable {
  std::vector<double> temperatures;  ///< [°C], increasing, at least one
  std::vector<double> log10_a_T;     ///< one per temperature
  bool operator==(const ShiftTable&) const = default;
};

using Shift = std::variant<NoShift, Wlf, Arrhenius, ShiftTable>;

inline constexpr double gas_constant = 8.314462618;  ///< R [J/(mol·K)]
inline constexpr double zero_celsius = 273.15;       ///< [K]

/// Returns log10 a_T at a temperature [°C]; NaN where the shift is not defined.
inline double log10_shift(const Shift& shift, double temperature) {
  struct At {
    double t;
    double operator()(const NoShift&) const { return 0; }
    double operator()(const Wlf& s) const {
      const double d = t - s.reference_temperature;
      return s.C2 + d > 0 ? -s.C1 * d / (s.C2 + d) : std::nan("");
    }
    double operator()(const Arrhenius& s) const {
      if (!(t > -zero_celsius)) return std::nan("");
      const double inverse = 1 / (zero_celsius + t) - 1 / (zero_celsius + s.reference_temperature);
      return s.activation_energy / (gas_constant * std::log(10.0)) * inverse;
    }
    double operator()(const ShiftTable& s) const {
      if (s.temperatures.empty() || !(t >= s.temperatures.front() && t <= s.temperatures.back())) return std::nan("");
      const auto above = static_cast<std::size_t>(std::lower_bound(s.temperatures.begin(), s.temperatures.end(), t) -
                                                  s.temperatures.begin());
      if (s.temperatures[above] == t) return s.log10_a_T[above];
      const double low = s.temperatures[above - 1], high = s.temperatures[above], x = (t - low) / (high - low);
      return (1 - x) * s.log10_a_T[above - 1] + x * s.log10_a_T[above];
    }
  };
  return std::visit(At{temperature}, shift);
}

/// Returns the law with every viscosity multiplied by a_T.
inline Law shifted(Law law, double a_T) {
  std::visit(
      [a_T](auto& l) {
        each_value(l, [a_T](const std::string&, double& value, ValueKind kind, ValueNeed) {
          if (kind == ValueKind::viscosity) value *= a_T;
        });
      },
      law);
  return law;
}

}  // namespace macadam::laws
