// SPDX-License-Identifier: GPL-3.0-or-later
/// \file creep.hpp  Defines the creep test: a stress is applied, at once or by a ramp, and held. If requested, it is
/// then removed. The result is the strain, which grows and then recovers.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "macadam/experiments/stepped.hpp"
#include "macadam/temperature.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "creep".
struct Creep {
  static constexpr const char* kind = "creep";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"creep.csv", "prony.csv", "kelvin.csv", "prony_abaqus.inp", "prony_ansys.txt"};

  double stress = 0;              ///< held stress [Pa], tension positive
  double ramp = 0;                ///< duration of the linear rise, and of the removal [s]; 0: at once
  std::optional<double> release;  ///< time at which the removal begins [s]; empty: never
  std::vector<double> times;      ///< times of the result, from the beginning of the ramp [s], rising
  /// For stepped tests: mass of the loaded top wall [kg]; empty: the smallest mass that does not shorten the time step.
  std::optional<double> platen_mass;
  double poisson_ratio = 0;             ///< Poisson's ratio for the tables of finite-element programs
  TemperatureHistory temperature = {};  ///< of the specimen; empty: constant
};

}  // namespace macadam::experiments
