// SPDX-License-Identifier: GPL-3.0-or-later
/// \file bending.hpp  Defines the cyclic bending test: the complex modulus of a beam between rollers (EN 12697-26,
/// annex B).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// Span over the length of the beam, if the scene gives no span.
inline constexpr double usual_span = 0.9;
/// Width of the rollers over the span, if the scene gives no width.
inline constexpr double usual_roller_width = 0.04;

/// `[loading]` of kind "bending": steady states at each frequency and each temperature.
struct Bending {
  static constexpr const char* kind = "bending";
  static constexpr Stepping stepping = Stepping::never;
  static constexpr std::array files = {"bending.csv"};  ///< files that a run may write

  std::vector<double> frequencies;     ///< [Hz], rising
  std::vector<double> temperatures;    ///< [°C]; empty: Materials::temperature
  int rollers = 4;                     ///< two below the beam, and one (3) or two (4) above it
  std::optional<double> span;          ///< distance of the lower rollers [m]
  std::optional<double> inner_span;    ///< distance of the two upper rollers [m]
  std::optional<double> roller_width;  ///< length of each roller along the beam [m]
  double poisson_ratio = 0.35;         ///< of the mixture, for the deflection by shear
};

}  // namespace macadam::experiments
