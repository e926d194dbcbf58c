// SPDX-License-Identifier: GPL-3.0-or-later
/// \file torsion.hpp  Defines the cyclic torsion test: the complex shear modulus of a cylinder between two glued
/// platens.
#pragma once

#include <array>
#include <vector>

#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "torsion": steady states at each frequency and each temperature, in which the top platen turns
/// about the axis of a cylinder and the bottom platen is at rest.
struct Torsion {
  static constexpr const char* kind = "torsion";
  static constexpr Stepping stepping = Stepping::never;
  static constexpr std::array files = {"torsion.csv"};  ///< files that a run may write

  std::vector<double> frequencies;   ///< [Hz], rising
  std::vector<double> temperatures;  ///< [°C]; empty: Materials::temperature
};

}  // namespace macadam::experiments
