// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cooling.hpp  Defines the thermal stress restrained specimen test (EN 12697-46): a specimen is glued between
/// two platens that do not move, and cools at a constant rate until it breaks.
#pragma once

#include <array>
#include <vector>

#include "macadam/experiments/stepped.hpp"
#include "macadam/temperature.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "cooling". The specimen is without stress at the first temperature. Only method "quasi_static"
/// follows this test.
struct Cooling {
  static constexpr const char* kind = "cooling";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"cooling.csv"};  ///< files that a run may write

  double from = 20, to = -30;           ///< first and last temperature [°C]
  double rate = 10.0 / 3600;            ///< at which the temperature falls [K/s], positive; 10 K/h, as in the standard
  std::vector<double> times;            ///< times of the result, from the beginning [s], rising
  TemperatureHistory temperature = {};  ///< of the specimen; it follows from the members above and is not a key
};

/// The numbers that a laboratory reports.
struct CoolingResults {
  double largest_stress_pa = 0;  ///< largest tensile stress; if the specimen broke, the fracture stress
  double temperature_c = 0;      ///< at the largest stress [°C]; if the specimen broke, the fracture temperature
  bool broke = false;            ///< in two pieces, suddenly, or by a fall of the stress to half of its largest value
};

}  // namespace macadam::experiments
