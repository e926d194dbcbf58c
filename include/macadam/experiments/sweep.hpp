// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sweep.hpp  Defines the sweep: the complex modulus over a range of frequencies and temperatures, which are the
/// data of a master curve.
#pragma once

#include <array>
#include <vector>

#include "macadam/experiments/frequency.hpp"
#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// `[loading]` of kind "sweep": steady states at each frequency and each temperature.
struct Sweep {
  static constexpr const char* kind = "sweep";
  static constexpr Stepping stepping = Stepping::never;
  static constexpr std::array files = {"sweep.csv"};  ///< files that a run may write

  std::vector<double> frequencies;   ///< [Hz], rising
  std::vector<double> temperatures;  ///< [°C]; empty: Materials::temperature
};

/// Result of a sweep.
struct SweepResult {
  std::vector<HarmonicFrequency> points;  ///< all frequencies of one temperature, then of the next
};

}  // namespace macadam::experiments
