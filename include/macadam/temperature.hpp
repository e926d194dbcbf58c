// SPDX-License-Identifier: GPL-3.0-or-later
/// \file temperature.hpp  Defines a temperature that changes during a test, and the thermal expansion of contacts
/// (docs/quasi-static.md).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/laws/shift.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// The temperature of the whole specimen during a test, linear between the given times. After the last time it stays
/// constant. Empty: the temperature does not change.
struct TemperatureHistory {
  std::vector<double> times;         ///< [s], rising, the first one is 0
  std::vector<double> temperatures;  ///< [°C], one for each time

  bool empty() const { return times.empty(); }
  /// Returns the temperature at a time [°C]. The history must not be empty.
  double at(double time) const {
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    if (next == times.begin()) return temperatures.front();
    if (next == times.end()) return temperatures.back();
    const auto i = static_cast<std::size_t>(next - times.begin());
    const double part = (time - times[i - 1]) / (times[i] - times[i - 1]);
    return (1 - part) * temperatures[i - 1] + part * temperatures[i];
  }
  bool operator==(const TemperatureHistory&) const = default;
};

/// Returns the reduced time ∫dt/a_T of a law between two times of a history [s]. At the reference temperature, the law
/// relaxes in this time as it does between the two times. NaN if the shift has no value at a temperature between them.
double reduced_time(const laws::Shift& shift, const TemperatureHistory& history, double from, double to);

/// Coefficients of linear thermal expansion of the phases [1/K].
struct Expansion {
  double aggregate = 0, mastic = 0;
  /// Returns whether a phase expands.
  bool any() const { return aggregate != 0 || mastic != 0; }
  /// Returns the coefficient of a phase [1/K]; 0 for voids.
  double of(Phase phase) const { return phase == Phase::aggregate ? aggregate : phase == Phase::mastic ? mastic : 0; }
};

/// Returns the opening of each contact in a specimen that expands freely, per kelvin [m/K]. It is the sum of
/// coefficient times length over the two parts of the line of centres: with rule "centres" the parts on both sides of
/// the facet, otherwise the parts in mastic and in rock.
std::vector<double> free_openings(const ContactNetwork& network, const Specimen& specimen, const Expansion& expansion);

}  // namespace macadam
