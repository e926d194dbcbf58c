// SPDX-License-Identifier: GPL-3.0-or-later
/// \file relaxation.hpp  The relaxation test: the top wall is displaced, at once or by a ramp, and held; stress decays.
#pragma once

#include <array>
#include <vector>

#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// `[loading]`, kind "relaxation".
struct Relaxation {
  static constexpr const char* kind = "relaxation";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"relaxation.csv", "prony.csv", "kelvin.csv", "prony_abaqus.inp",
                                       "prony_ansys.txt"};

  double strain = 1e-4;       ///< that is held, tension positive
  double ramp = 0;            ///< over which it grows evenly [s]; 0: at once
  std::vector<double> times;  ///< from the beginning of the ramp [s], rising
  double poisson_ratio = 0;   ///< for the tables of finite-element programs
};

}  // namespace macadam::experiments
