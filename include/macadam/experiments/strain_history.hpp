// SPDX-License-Identifier: GPL-3.0-or-later
/// \file strain_history.hpp  Defines the test of a strain history: the top wall moves as any drive of drives/all.hpp
/// says.
#pragma once

#include <array>

#include "macadam/drives/all.hpp"
#include "macadam/experiments/stepped.hpp"
#include "macadam/temperature.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "history".
struct StrainHistory {
  static constexpr const char* kind = "history";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"history.csv", "prony.csv", "kelvin.csv", "prony_abaqus.inp", "prony_ansys.txt"};

  drives::AnySpec drive;                ///< strain of the specimen over time
  double duration = 0;                  ///< of the test [s]
  int samples = 200;                    ///< number of points of the result, evenly spaced
  double poisson_ratio = 0;             ///< Poisson's ratio for the tables of finite-element programs
  TemperatureHistory temperature = {};  ///< of the specimen; empty: constant
};

}  // namespace macadam::experiments
