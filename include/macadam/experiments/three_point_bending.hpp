// SPDX-License-Identifier: GPL-3.0-or-later
/// \file three_point_bending.hpp  Defines the bending test of a beam to failure: a roller presses the middle of a beam,
/// which rests on two rollers and may have a notch (RILEM TC 50-FMC, ASTM E399).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "macadam/experiments/load_results.hpp"
#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "three_point_bending". Strains are the displacement of the upper roller over the height, and
/// stresses the load over the horizontal section of the beam; both are negative, as in every compression.
struct ThreePointBending {
  static constexpr const char* kind = "three_point_bending";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"three_point_bending.csv"};  ///< files that a run may write
  static constexpr double usual_span = 4;             ///< span over the height, if the scene gives no span (ASTM E399)
  static constexpr double usual_roller_width = 0.04;  ///< width of the rollers over the span, if the scene gives none

  double rate = 0;                     ///< at which the upper roller moves down [m/s]
  std::vector<double> times;           ///< times of the result, from the beginning [s], rising
  std::optional<double> span;          ///< distance of the two lower rollers [m]
  std::optional<double> roller_width;  ///< length of each roller along the beam [m]
  double height = 0;                   ///< of the scene's beam [m]; not a key
};

/// The numbers that a laboratory reports.
struct BeamStrength : LoadResults {
  double notch_m = 0;               ///< length of the notch; 0: no notch
  double fracture_energy_j_m2 = 0;  ///< work over the area of the ligament, (height − notch)·width (RILEM TC 50-FMC)
  /// Flexural strength, 3·load·span/(2·width·height²): the largest stress of a beam without shear. Empty with a notch.
  std::optional<double> strength_pa;
  /// Fracture toughness K_Ic (ASTM E399). Empty without a notch in the middle of the beam, and if the span is not four
  /// times the height.
  std::optional<double> toughness_pa_sqrt_m;
};

}  // namespace macadam::experiments
