// SPDX-License-Identifier: GPL-3.0-or-later
/// \file isotherms.hpp  Readings of a thermometer as the temperatures of a test.
#pragma once

#include <cstddef>
#include <vector>

namespace macadam::fitting {

/// Readings that one temperature of the test gave.
struct Isotherm {
  double temperature = 0;          ///< their mean, rounded to 0.01 K where they differ [°C]
  double lowest = 0, highest = 0;  ///< of the readings [°C]
};

/// Neighbouring readings that differ by at most this belong to one isotherm [K]: chambers hold a few tenths of a
/// kelvin, and tests choose temperatures that lie some kelvins apart.
inline constexpr double same_isotherm = 0.5;
/// Readings of one isotherm lie within this [K].
inline constexpr double widest_isotherm = 1;

/// The isotherms of readings in any order, rising. Readings that follow each other closely over more than
/// `widest_isotherm`, as on a ramp, are cut into pieces of that width.
std::vector<Isotherm> isotherms_of(std::vector<double> readings);

/// Number of the isotherm whose readings lie nearest to a temperature.
std::size_t isotherm_at(const std::vector<Isotherm>& isotherms, double temperature);

/// Distance of a temperature from the readings of an isotherm [K]; 0 within them.
double distance_from(const Isotherm& isotherm, double temperature);

}  // namespace macadam::fitting
