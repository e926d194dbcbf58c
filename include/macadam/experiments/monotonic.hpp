// SPDX-License-Identifier: GPL-3.0-or-later
/// \file monotonic.hpp  Defines the monotonic test: the top wall moves at a constant strain rate, in tension or
/// compression.
#pragma once

#include <array>
#include <vector>

#include "macadam/experiments/stepped.hpp"
#include "macadam/temperature.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "monotonic".
struct Monotonic {
  static constexpr const char* kind = "monotonic";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"monotonic.csv", "prony.csv", "kelvin.csv", "prony_abaqus.inp",
                                       "prony_ansys.txt"};

  double rate = 0;                      ///< strain rate [1/s], tension positive
  std::vector<double> times;            ///< times of the result, from the beginning [s], rising
  double poisson_ratio = 0;             ///< Poisson's ratio for the tables of finite-element programs
  TemperatureHistory temperature = {};  ///< of the specimen; empty: constant
};

}  // namespace macadam::experiments
