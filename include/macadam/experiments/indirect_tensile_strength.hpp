// SPDX-License-Identifier: GPL-3.0-or-later
/// \file indirect_tensile_strength.hpp  Defines the indirect tension test to failure: two strips approach each other at
/// a constant rate and split a disc (EN 12697-23, ASTM D8225).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "macadam/experiments/load_results.hpp"
#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "indirect_tensile_strength". Strains are the approach of the strips over the diameter, and
/// stresses the load over diameter·thickness; both are negative, as in every compression.
struct IndirectTensileStrength {
  static constexpr const char* kind = "indirect_tensile_strength";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"indirect_tensile_strength.csv"};

  std::optional<double> strip_width;  ///< [m]
  double rate = 0.05 / 60;            ///< at which the strips approach each other [m/s]; the standards' 50 mm/min
  std::vector<double> times;          ///< times of the result, from the beginning [s], rising
  double diameter = 0;                ///< of the scene's disc [m]; not a key
};

/// The numbers that a laboratory reports. Slope, l75 and CT index are those of the IDEAL-CT (ASTM D8225). They are
/// empty if the load did not fall to 65 % of its largest value, or if fewer than two samples lie between 85 and 65 %.
struct DiscStrength : LoadResults {
  double strength_pa = 0;           ///< indirect tensile strength, 2·load/(π·diameter·thickness)
  double fracture_energy_j_m2 = 0;  ///< work over diameter·thickness
  std::optional<double> slope_n_m;  ///< |m75|: mean slope between 85 and 65 % of the largest load, after it
  std::optional<double> l75_m;      ///< approach at which the load has fallen to 75 % of its largest value
  std::optional<double> ct_index;   ///< (thickness/62 mm)·(l75/diameter)·10⁶·fracture energy/|m75|
};

}  // namespace macadam::experiments
