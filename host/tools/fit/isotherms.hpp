// SPDX-License-Identifier: GPL-3.0-or-later
/// \file isotherms.hpp  Groups thermometer readings into the temperatures of a test.
#pragma once

#include <cstddef>
#include <vector>

namespace macadam::fitting {

/// The readings that belong to one temperature of the test.
struct Isotherm {
  double temperature = 0;          ///< mean of the readings, rounded to 0.01 K if they differ [°C]
  double lowest = 0, highest = 0;  ///< smallest and largest reading [°C]
};

/// Consecutive readings, in ascending order, belong to one isotherm if they differ by at most this [K]. Temperature
/// chambers hold a few tenths of a kelvin, and test temperatures lie some kelvins apart.
inline constexpr double same_isotherm = 0.5;
/// Largest difference between the readings of one isotherm [K].
inline constexpr double widest_isotherm = 1;

/// Returns the isotherms of readings, which may be in any order; isotherms ascend. If closely spaced readings cover
/// more than `widest_isotherm`, as in a temperature ramp, they are divided into isotherms of that width.
std::vector<Isotherm> isotherms_of(std::vector<double> readings);

/// Returns the number of the isotherm whose readings are nearest to a temperature.
std::size_t isotherm_at(const std::vector<Isotherm>& isotherms, double temperature);

/// Returns the distance of a temperature from the readings of an isotherm [K]; 0 if it lies between them.
double distance_from(const Isotherm& isotherm, double temperature);

}  // namespace macadam::fitting
