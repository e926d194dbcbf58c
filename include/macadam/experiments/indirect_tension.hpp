// SPDX-License-Identifier: GPL-3.0-or-later
/// \file indirect_tension.hpp  Defines the cyclic indirect tension test: the complex modulus of a disc that two strips
/// load across its diameter (EN 12697-26, annexes C and F).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// Width of the strips over the diameter of the disc, if the scene gives none: 12.7 mm for 100 mm, as in the standards.
inline constexpr double usual_strip = 0.127;

/// `[loading]` of kind "indirect_tension": steady states at each frequency and each temperature.
struct IndirectTension {
  static constexpr const char* kind = "indirect_tension";
  static constexpr Stepping stepping = Stepping::never;
  static constexpr std::array files = {"indirect_tension.csv"};  ///< files that a run may write

  std::vector<double> frequencies;    ///< [Hz], rising
  std::vector<double> temperatures;   ///< [°C]; empty: Materials::temperature
  std::optional<double> strip_width;  ///< [m]
  /// Poisson's ratio with which the modulus follows from the horizontal deformation alone. Empty: both follow from the
  /// horizontal and the vertical deformation.
  std::optional<double> poisson_ratio;
};

}  // namespace macadam::experiments
