// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_points.hpp  Reads the keys of `[loading]` that several experiments have: lists of times, frequencies and
/// temperatures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/scene/table.hpp"
#include "macadam/temperature.hpp"

namespace macadam::scene {

/// Returns a key that accepts `kind` without reading it, because the kind is already known when an experiment reads its
/// section.
inline Key kind_key() {
  return {"kind", Need::required, {[](const Value&) {}, {"one of"}}, "kind of the test; it determines the other keys"};
}

/// Sets the target to its default and returns the key `poisson_ratio` of `[loading]`.
Key poisson_key(double& target);

/// Returns the key `strip_width` of `[loading]`.
Key strip_width_key(std::optional<double>& target);

/// Returns the key `temperature` of `[loading]`: pairs of a time and a temperature.
Key temperature_key(TemperatureHistory& target);

/// Rate and end of a test in which the two loaded walls approach each other, and the rows of its result.
struct Approach {
  std::optional<double> rate;  ///< [m/s]
  double displacement = 0;     ///< at the end [m]
  int points = 200;

  /// Returns the keys `kind`, `rate`, `displacement` and `points`. The first two arguments explain `rate` and
  /// `displacement`. `usual_rate`: the rate without the key; if it is empty, the key `rate` is required.
  std::vector<Key> keys(const std::string& of_rate, const std::string& of_displacement,
                        const std::string& usual_rate = "50 mm/min, as in the standards");
  /// Returns the times of the rows at a rate [s], evenly spaced.
  std::vector<double> times(double at_rate) const;
};

/// Checks a list. \throws InputError if the key is given without entries, or has the same entry twice.
void require_once(const Section& section, const std::string& key, std::vector<double> entries, const char* unit,
                  const char* what);

/// Times or frequencies in a scene: either a list, or the two ends of a range with the key `points_per_decade` or
/// `points`.
struct Points {
  std::vector<double> given;
  std::optional<int> per_decade, evenly;

  /// Returns the keys `key`, `points_per_decade` and `points`.
  std::vector<Key> keys(const std::string& key, const Quantity& quantity, Need need = Need::required);
  /// Returns all points in rising order. \throws InputError
  std::vector<double> all(const Section& section, const std::string& key, const char* unit, const char* what) const;
};

/// Reads `[loading]` of a test whose steady states are solved at each frequency [Hz] and each temperature [°C]. `more`:
/// the keys that only this test has. \throws InputError
void read_steady_states(const Section& section, std::vector<double>& frequencies, std::vector<double>& temperatures,
                        const std::vector<Key>& more = {});

}  // namespace macadam::scene
