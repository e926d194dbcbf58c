// SPDX-License-Identifier: GPL-3.0-or-later
/// \file creep.hpp  The creep test: a stress, at once or by a ramp, is held, and taken off again if asked; strain grows
/// and recovers.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// `[loading]`, kind "creep".
struct Creep {
  static constexpr const char* kind = "creep";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"creep.csv", "prony.csv", "kelvin.csv", "prony_abaqus.inp", "prony_ansys.txt"};

  double stress = 0;                  ///< that is held [Pa], tension positive
  double ramp = 0;                    ///< over which it grows evenly, and is taken off [s]; 0: at once
  std::optional<double> release;      ///< when it begins to be taken off [s]; nothing: never
  std::vector<double> times;          ///< from the beginning of the ramp [s], rising
  std::optional<double> platen_mass;  ///< stepped: of the loaded top wall [kg]; nothing: the least that costs no step
  double poisson_ratio = 0;           ///< for the tables of finite-element programs
};

}  // namespace macadam::experiments
