// SPDX-License-Identifier: GPL-3.0-or-later
/// \file solution_range.hpp  Places at which a network is solved to find its relaxation, and the accuracy of these
/// solutions.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "macadam/harmonic.hpp"
#include "macadam/spectrum.hpp"

namespace macadam::solution_range {

/// The network is solved at |s| from about 0.1/longest to 10/shortest, because E(t) depends on E*(s) for s from about
/// 0.1/t to 10/t.
inline constexpr double slower = 10, faster = 10;
/// The instantaneous response, in which no dashpot moves, is solved at s = at_once/t. Here t is the fastest relaxation
/// time, or the shortest requested time if this is less.
inline constexpr double at_once = 1e8;
/// The residual tolerance of the solutions is residual_share·√tolerance, because the error of E* is the square of the
/// error of a solution.
inline constexpr double residual_share = 1e-4;
/// The error estimate contains this fraction of the tolerance, as an allowance for the residuals of the solutions. For
/// a specimen of 175 particles the residuals alone caused an error of 0.03 times the tolerance.
inline constexpr double of_residuals = 0.1;
/// The network is solved at 9 places in the first round, at 17, 33 and 65 in the next rounds.
inline constexpr int first_places = 9, most_rounds = 4;
/// Number of frequencies at which the series is compared with solutions that were not used to make it.
inline constexpr int checks = 3;

/// Compares a series with solutions that were not used to make it, at frequencies within the range of times. Returns
/// the largest difference of the modulus, relative to |E*|. `exact`: returns E* of the solution for a load.
template <class F>
double largest_difference(const PronySeries& series, const SpectrumOptions& options, F&& exact) {
  const double slow = 1 / (2 * std::numbers::pi * options.longest),
               fast = 1 / (2 * std::numbers::pi * options.shortest);
  double out = 0;
  for (int i = 0; i < checks; ++i) {
    const HarmonicLoad load{slow * std::pow(fast / slow, (i + 0.5) / checks)};
    out = std::max(out, std::abs(series.stiffness(load.s()) / exact(load) - 1.0));
  }
  return out;
}

/// Returns the shortest relaxation time of all laws [s], infinity if no law relaxes.
inline double fastest_time(const LawTable& laws) {
  double out = std::numeric_limits<double>::infinity();
  for (const auto& law : laws) {
    if (!law) continue;
    for (const PronySeries::Unit& u : prony_series(*law).units) out = std::min(out, u.time);
  }
  return out;
}

}  // namespace macadam::solution_range
