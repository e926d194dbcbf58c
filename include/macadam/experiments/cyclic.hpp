// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cyclic.hpp  Defines the cyclic test: the top wall moves as −A·sin(2πft), and |E*| and φ follow from the sine
/// of the stress.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "macadam/experiments/cracks.hpp"
#include "macadam/experiments/frequency.hpp"
#include "macadam/experiments/increments.hpp"
#include "macadam/experiments/stepped.hpp"

namespace macadam {

/// How a cyclic test starts. `rest`: from zero displacement. `steady`: from the harmonic solution, so that the first
/// cycle is already periodic.
enum class Start : std::uint8_t { rest, steady };
const char* to_string(Start);

namespace experiments {

/// `[loading]` of kind "cyclic". make_plan() decides options that are empty.
struct Cyclic {
  static constexpr const char* kind = "cyclic";
  static constexpr Stepping stepping = Stepping::usual;
  static constexpr std::array files = {"response.csv"};  ///< files that a run may write

  std::vector<double> frequencies;  ///< [Hz]
  /// Temperatures [°C]. Every frequency is solved at each of these temperatures. For the harmonic method only. If
  /// empty, Materials::temperature is used.
  std::vector<double> temperatures;
  double strain_amplitude = 1e-4;  ///< relative to the height of the specimen
  std::optional<Start> start;
  std::optional<int> cycles;
  std::optional<double> ramp_cycles;  ///< length of the smooth start in cycles, ≤ cycles − fit_cycles
  std::optional<int> fit_cycles;      ///< number of cycles at the end that are fitted
  int samples_per_cycle = 500;        ///< samples per cycle in response.csv

  /// Returns the number of cycles that are fitted at the end of a test of `of_cycles` cycles: `fit_cycles` if it is
  /// given, otherwise two if the test has at least four cycles, else one.
  int fitted(int of_cycles) const { return fit_cycles.value_or(of_cycles >= 4 ? 2 : 1); }
};

/// Result of one frequency by stepping.
struct SteppedFrequency : Frequency {
  CyclicResult cyclic;  ///< fit, peaks, steadiness
  double dt_s = 0;
  std::int64_t steps = 0;
  int cycles = 0;
  Start start = Start::rest;
  /// Whether the error is within the requested tolerance; empty without a harmonic solution to compare with.
  std::optional<bool> kept;
  /// Predicted and measured difference from the harmonic solution at true mass; empty without such a solution.
  std::optional<ErrorEstimate> predicted, achieved;
  /// Contact points that broke; empty if no law of the scene can break. Each frequency begins with an intact specimen.
  std::optional<Cracks> cracks = {};
  /// The rupture, if it ended the steps of this frequency early. |E*| and φ are then NaN.
  std::optional<Rupture> rupture = {};
  std::optional<Increments> increments = {};  ///< only method "quasi_static"
  /// |E*| and φ of each single cycle that was sampled, from the first one on; only method "quasi_static" with cracks.
  std::vector<Stiffness> cycle_stiffness = {};

  /// Returns the rms difference of the stress from its fit, over the stress amplitude.
  double residual() const { return cyclic.fit_rms; }
};

/// Result of a cyclic test by methods "explicit" and "quasi_static".
struct SteppedCyclic : Stepped {
  std::vector<SteppedFrequency> frequencies;
};

/// Result of a cyclic test by method "harmonic".
struct HarmonicCyclic {
  std::vector<HarmonicFrequency> frequencies;
};

}  // namespace experiments
}  // namespace macadam
