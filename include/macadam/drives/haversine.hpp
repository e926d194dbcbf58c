// SPDX-License-Identifier: GPL-3.0-or-later
/// \file haversine.hpp  Defines pulses with pauses between them: the load in tests of resilient modulus, permanent
/// deformation and fatigue.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "macadam/drives/drive.hpp"
#include "macadam/drives/spec.hpp"

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

/// Description of pulses with pauses between them.
struct HaversineSpec {
  static constexpr const char* name = "haversine";
  double strain = 0;                   ///< peak
  double pulse = 0;                    ///< duration of a pulse [s]
  double rest = 0;                     ///< pause after a pulse [s]
  std::optional<std::int64_t> pulses;  ///< empty: until the end of the test

  template <class F>
  void each_key(F&& f) {
    f("strain", strain, ValueKind::strain, ValueNeed::required, "peak of the strain");
    f("pulse", pulse, ValueKind::time, ValueNeed::required, "duration of a pulse");
    f("rest", rest, ValueKind::pause, ValueNeed::optional, "pause after each pulse");
    f("pulses", pulses, ValueKind::number, ValueNeed::optional, "number of pulses");
  }
  std::optional<SpecFault> fault(double duration) const {
    if (rest > 0 && duration / (pulse + rest) > most_pieces / 2)
      return SpecFault{"pulse", "more than 500000 pulses until the end of the test", "at most 500000"};
    return {};
  }
  StrainRange range(double) const { return {std::min(0.0, strain), std::max(0.0, strain)}; }
  double shortest_time(double) const { return pulse / (2 * std::numbers::pi); }
  double step(double largest, double) const { return dividing_step({pulse, rest}, largest); }
  std::shared_ptr<const Drive> drive(double unit, double dt, double) const {
    return std::make_shared<Haversine>(unit * strain, dt, std::llround(pulse / dt), std::llround(rest / dt),
                                       pulses.value_or(Haversine::forever));
  }
  /// The rate within a pulse is strain·π/pulse·sin(2πu/pulse).
  std::vector<RatePiece> pieces(double duration) const {
    const RateWave wave{{0, -strain * std::numbers::pi / pulse}, 2 * std::numbers::pi / pulse};
    std::vector<RatePiece> out;
    if (rest == 0) {
      append_piece(out, pulses ? static_cast<double>(*pulses) * pulse : duration, duration, {wave});
    } else {
      for (std::int64_t k = 0; !pulses || k < *pulses; ++k) {
        const double begin = static_cast<double>(k) * (pulse + rest);
        if (!append_piece(out, begin + pulse, duration, {wave})) return out;
        if (!append_piece(out, begin + (pulse + rest), duration, {})) return out;
      }
    }
    append_piece(out, duration, duration, {});
    return out;
  }
};

}  // namespace macadam::drives
