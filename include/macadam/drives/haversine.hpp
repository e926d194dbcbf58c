// SPDX-License-Identifier: GPL-3.0-or-later
/// \file haversine.hpp  Defines pulses with pauses between them: the load in tests of resilient modulus, permanent
/// deformation and fatigue.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "macadam/drives/drive.hpp"

namespace macadam::drives {

/// height·sin²(π·t/pulse), which equals ½·height·(1 − cos(2π·t/pulse)), within a pulse, and 0 in the pause after it.
/// Pulse and pause are whole numbers of steps, so no rounding error accumulates from pulse to pulse.
struct Haversine final : Drive {
  static constexpr std::int64_t forever = std::numeric_limits<std::int64_t>::max();
  double height = 0;             ///< peak value [m] or [N]; on the top wall, a negative value is compression
  double step = 0;               ///< Δt [s]
  std::int64_t pulse_steps = 1;  ///< steps of a pulse
  std::int64_t rest_steps = 0;   ///< steps from the end of a pulse to the next one
  std::int64_t pulses = forever;

  Haversine() = default;
  Haversine(double height, double step, std::int64_t pulse_steps, std::int64_t rest_steps,
            std::int64_t pulses = forever)
      : height(height), step(step), pulse_steps(pulse_steps), rest_steps(rest_steps), pulses(pulses) {}

  double dt() const override { return step; }
  double shortest_time() const override { return static_cast<double>(pulse_steps) * step; }
  double fastest() const override { return std::abs(height) * std::numbers::pi / shortest_time(); }
  double value(std::int64_t k) const override {
    const double s = std::sin(std::numbers::pi * share(k));
    return height * (s * s);
  }
  /// Uses sin²b − sin²a = sin(b − a)·sin(b + a), which has no cancellation.
  double rate(std::int64_t k) const override {
    if (!within(k)) return 0;
    const double a = std::numbers::pi * share(k), turn = std::numbers::pi / static_cast<double>(pulse_steps);
    return height * (std::sin(turn) * std::sin(2 * a + turn)) / step;
  }

 private:
  std::int64_t period() const { return pulse_steps + rest_steps; }
  /// Returns whether the step from k to k + 1 is within a pulse.
  bool within(std::int64_t k) const { return k >= 0 && k / period() < pulses && k % period() < pulse_steps; }
  /// Returns the fraction of the pulse that has passed at step k; 0 in a pause.
  double share(std::int64_t k) const {
    return within(k) ? static_cast<double>(k % period()) / static_cast<double>(pulse_steps) : 0;
  }
};

}  // namespace macadam::drives
