// SPDX-License-Identifier: GPL-3.0-or-later
/// \file spec.hpp  Defines the contract of a drive's description: the values that a scene gives for the strain of the
/// top wall over time. A description does not depend on the time step.
///
/// Every drive of all.hpp has a description, for example HaversineSpec beside Haversine. A description is a plain
/// struct of strains (tension positive) and times, with
///   - `static constexpr const char* name` — the value of the key `drive` in a scene;
///   - `template <class F> void each_key(F&& f)` — calls f(key, member, ValueKind, ValueNeed, text) for each value that
///     a scene may set: a double, an optional double or whole number (empty: until the end of the test), a bool, or a
///     list of doubles. Two drives that have a key with the same name must have the same type and ValueKind for it;
///   - `std::optional<SpecFault> fault(double duration) const` — reports values that do not fit together
///     or do not fit the duration of the test [s];
///   - `StrainRange range(double duration) const` — the smallest and the largest strain until then;
///   - `double shortest_time(double duration) const` — the shortest time in which the strain changes much [s];
///   - `double step(double largest, double duration) const` — the time step for a run [s], at most `largest`. The
///     durations of the drive are whole numbers of such steps, if possible;
///   - `std::shared_ptr<const Drive> drive(double unit, double dt, double duration) const` — the drive for steps of
///     `dt` [s]. `unit`: the displacement at a strain of 1 [m];
///   - `std::vector<RatePiece> pieces(double duration) const` — the strain rate as a sum of sines, piece by piece, from
///     which the response of a linear specimen follows in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "macadam/drives/drive.hpp"

namespace macadam::drives {

/// Kind of a value of a description. `pause` is a time that may be 0; `number` is a whole number or true/false.
enum class ValueKind : std::uint8_t { strain, rate, frequency, time, pause, number };
/// Whether a scene must give a value.
enum class ValueNeed : std::uint8_t { required, optional };

/// A value that is valid by itself but contradicts other values or the duration of the test.
struct SpecFault {
  std::string key, found, expected;
};

/// The smallest and the largest strain of a history.
struct StrainRange {
  double lowest, highest;
};

/// A part of a strain rate: Re(amplitude·e^(i·omega·u)) at the time u after the beginning of the piece. With omega = 0
/// the rate is constant.
struct RateWave {
  std::complex<double> amplitude;  ///< [1/s]
  double omega;                    ///< [1/s]
};

/// The strain rate from `begin` to `end` [s]: the sum of its waves, 0 if it has none.
struct RatePiece {
  double begin, end;
  std::vector<RateWave> waves;
};

/// Largest number of pieces of a history.
inline constexpr double most_pieces = 1e6;

/// Appends a piece that is cut off at `duration`. Returns whether the next piece would begin before `duration`.
inline bool append_piece(std::vector<RatePiece>& pieces, double end, double duration, std::vector<RateWave> waves) {
  const double begin = pieces.empty() ? 0 : pieces.back().end;
  if (end > begin) pieces.push_back({begin, std::min(end, duration), std::move(waves)});
  return end < duration;
}

/// Returns a time step that divides the first of `durations` and is at most about `largest`. Among the steps down to a
/// tenth shorter than the largest possible one, returns the largest step that also divides the other durations or, if
/// no step does, the step for which the other durations must be rounded least. Durations of 0 are ignored.
inline double dividing_step(std::initializer_list<double> durations, double largest) {
  const double first = *durations.begin();
  const double fewest = std::ceil(first / largest), most = std::min(fewest + 1000, 1.1 * fewest + 1);
  double best = first / fewest, smallest = INFINITY;
  for (double n = fewest; n <= most; ++n) {
    const double step = first / n;
    double rounding = 0;
    for (const double d : durations) {
      if (d > 0) rounding = std::max(rounding, std::abs(std::round(d / step) * step / d - 1));
    }
    if (rounding < 0.1 * smallest) best = step, smallest = rounding;
    if (rounding < 1e-12) break;
  }
  return best;
}

/// The contract of a description, except for each_key().
template <class S>
concept DriveSpec = requires(const S& spec, double x) {
  { S::name } -> std::convertible_to<const char*>;
  { spec.fault(x) } -> std::same_as<std::optional<SpecFault>>;
  { spec.range(x) } -> std::same_as<StrainRange>;
  { spec.shortest_time(x) } -> std::same_as<double>;
  { spec.step(x, x) } -> std::same_as<double>;
  { spec.drive(x, x, x) } -> std::same_as<std::shared_ptr<const Drive>>;
  { spec.pieces(x) } -> std::same_as<std::vector<RatePiece>>;
};

}  // namespace macadam::drives
