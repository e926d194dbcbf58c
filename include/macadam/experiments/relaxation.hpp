// SPDX-License-Identifier: GPL-3.0-or-later
/// \file relaxation.hpp  Defines the relaxation test: the top wall is displaced, at once or by a ramp, and held; the
/// stress decays.
#pragma once

#include <array>
#include <vector>

#include "macadam/experiments/stepped.hpp"
#include "macadam/temperature.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "relaxation".
struct Relaxation {
  static constexpr const char* kind = "relaxation";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"relaxation.csv", "prony.csv", "kelvin.csv", "prony_abaqus.inp",
                                       "prony_ansys.txt"};

  double strain = 1e-4;                 ///< held strain, tension positive
  double ramp = 0;                      ///< duration of the linear rise [s]; 0: at once
  std::vector<double> times;            ///< times of the result, from the beginning of the ramp [s], rising
  double poisson_ratio = 0;             ///< Poisson's ratio for the tables of finite-element programs
  TemperatureHistory temperature = {};  ///< of the specimen; empty: constant
};

}  // namespace macadam::experiments
