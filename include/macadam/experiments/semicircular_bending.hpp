// SPDX-License-Identifier: GPL-3.0-or-later
/// \file semicircular_bending.hpp  Defines the semicircular bending test to failure: a roller presses the crown of a
/// half disc, which rests on two rollers (AASHTO T 393, EN 12697-44).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "macadam/experiments/load_results.hpp"
#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "semicircular_bending". Strains are the displacement of the upper roller over the radius, and
/// stresses the load over the section at half of the height; both are negative, as in every compression.
struct SemicircularBending {
  static constexpr const char* kind = "semicircular_bending";
  static constexpr Stepping stepping = Stepping::if_asked;
  static constexpr std::array files = {"semicircular_bending.csv"};  ///< files that a run may write
  static constexpr double usual_span =
      0.8;  ///< span over the diameter, if the scene gives no span; as in the standards
  static constexpr double usual_roller_width = 0.1;  ///< width of the rollers over the radius, if the scene gives none

  double rate = 0.05 / 60;             ///< at which the upper roller moves down [m/s]; the standards' 50 mm/min
  std::vector<double> times;           ///< times of the result, from the beginning [s], rising
  std::optional<double> span;          ///< distance of the two lower rollers [m]
  std::optional<double> roller_width;  ///< length of each roller along x [m]
  double radius = 0;                   ///< of the scene's half disc [m]; not a key
};

/// The numbers that a laboratory reports.
struct HalfDiscStrength : LoadResults {
  double notch_m = 0;               ///< length of the notch; 0: no notch
  double fracture_energy_j_m2 = 0;  ///< work over the area of the ligament, (radius − notch)·thickness
  /// |m|: steepest mean slope of the curve after the largest load, over a window of a tenth of the displacement at the
  /// largest load. Empty if the load did not fall to half of its largest value.
  std::optional<double> slope_n_m;
  std::optional<double> flexibility_index;  ///< 0.01·(fracture energy in J/m²)/(|m| in kN/mm)
  /// Largest bending stress, 4.263·load/(diameter·thickness) (EN 12697-44). Empty if the span is not 0.8 of the
  /// diameter.
  std::optional<double> strength_pa;
  /// Fracture toughness K_Ic (AASHTO TP 105). Empty without a notch in the middle of the flat side, and if the span is
  /// not 0.8 of the diameter.
  std::optional<double> toughness_pa_sqrt_m;
};

}  // namespace macadam::experiments
