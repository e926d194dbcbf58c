// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cyclic.hpp  The cyclic test: the top wall moves as −A·sin(2πft), stress answers as a sine, |E*| and φ follow.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "macadam/experiments/frequency.hpp"
#include "macadam/experiments/stepped.hpp"

namespace macadam {

/// `rest`: from zero displacement. `steady`: from the harmonic solution, so that the first cycle is periodic already.
enum class Start : std::uint8_t { rest, steady };
const char* to_string(Start);

namespace experiments {

/// `[loading]`, kind "cyclic". What is empty was not given: make_plan() decides it.
struct Cyclic {
  static constexpr const char* kind = "cyclic";
  static constexpr Stepping stepping = Stepping::usual;
  static constexpr std::array files = {"response.csv"};  ///< that a run may leave

  std::vector<double> frequencies;   ///< [Hz]
  std::vector<double> temperatures;  ///< [°C], every frequency at each; harmonic only; empty: Materials::temperature
  double strain_amplitude = 1e-4;    ///< of the height
  std::optional<Start> start;
  std::optional<int> cycles;
  std::optional<double> ramp_cycles;  ///< smooth start over so many cycles, ≤ cycles − fit_cycles
  std::optional<int> fit_cycles;      ///< last cycles that are fitted
  int samples_per_cycle = 500;        ///< points of response.csv in a cycle

  /// Last cycles that are fitted of so many: as given, else two of four or more, else one.
  int fitted(int of_cycles) const { return fit_cycles.value_or(of_cycles >= 4 ? 2 : 1); }
};

/// One frequency, stepped.
struct SteppedFrequency : Frequency {
  CyclicResult cyclic;  ///< fit, peaks, steadiness
  double dt_s = 0;
  std::int64_t steps = 0;
  int cycles = 0;
  Start start = Start::rest;
  /// Whether the tolerance that was asked for was kept; nothing where there is no harmonic solution to tell.
  std::optional<bool> kept;
  std::optional<ErrorEstimate> predicted, achieved;  ///< against the harmonic solution at true mass, if there is one

  double residual() const { return cyclic.fit_rms; }  ///< rms of stress that the fit leaves / amplitude
};

/// By method "explicit".
struct SteppedCyclic : Stepped {
  std::vector<SteppedFrequency> frequencies;
};

/// By method "harmonic".
struct HarmonicCyclic {
  std::vector<HarmonicFrequency> frequencies;
};

}  // namespace experiments
}  // namespace macadam
