// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cyclic.hpp  Defines a sine, −A·r(t)·sin(2πft). On the top wall it begins with compression ([1], section 4.4;
/// model (13.1)).
#pragma once

#include <cmath>
#include <numbers>

#include "macadam/drives/drive.hpp"
#include "macadam/drives/spec.hpp"

namespace macadam::drives {

/// The drive −A·r(t)·sin(2πft). A period is a whole number of steps, so the phase of step k is exact in runs of any
/// length. The ramp r(t) rises from 0 to 1 over `ramp_steps` as a half cosine; with 0 ramp steps, r = 1 from the start.
struct Cyclic final : Drive {
  double amplitude = 0;  ///< A [m] or [N]
  double frequency = 0;  ///< f [Hz]
  std::int64_t steps_per_period = 1;
  std::int64_t ramp_steps = 0;

  Cyclic() = default;
  Cyclic(double amplitude, double frequency, std::int64_t steps_per_period, std::int64_t ramp_steps = 0)
      : amplitude(amplitude), frequency(frequency), steps_per_period(steps_per_period), ramp_steps(ramp_steps) {}

  double dt() const override { return 1.0 / (frequency * static_cast<double>(steps_per_period)); }
  double shortest_time() const override { return 1 / frequency; }
  double fastest() const override { return std::abs(amplitude) * 2 * std::numbers::pi * frequency; }
  bool begins() const override { return ramp_steps > 0; }
  double value(std::int64_t k) const override { return value(k, 0); }

  /// Returns the value at step k + half/2; half is 0 or 1.
  double value(std::int64_t k, int half) const { return -amplitude * ramp(k, half) * std::sin(phase(k, half)); }

  /// Returns the difference of two values over Δt, in a form without cancellation.
  double rate(std::int64_t k) const override {
    const double half_step = std::numbers::pi / static_cast<double>(steps_per_period);
    double v = 2 * ramp(k, 1) * std::sin(half_step) * std::cos(phase(k, 1));
    if (ramping(k)) {  // adds (rise of r over the step)·(sine at mid-step); the error is of second order in Δt
      v += (ramp(k + 1, 0) - ramp(k, 0)) * std::sin(phase(k, 1));
    }
    return -amplitude * v / dt();
  }

 private:
  /// Returns whether step k is within the ramp. A run that starts from a state of motion also asks for step −1, which
  /// is not within the ramp.
  bool ramping(std::int64_t k) const { return k >= 0 && k < ramp_steps; }
  double phase(std::int64_t k, int half) const {
    const double in_period = static_cast<double>(k % steps_per_period) + 0.5 * half;
    return 2 * std::numbers::pi * (in_period / static_cast<double>(steps_per_period));
  }
  double ramp(std::int64_t k, int half) const {
    if (!ramping(k)) return 1.0;
    const double s =
        std::sin(std::numbers::pi / 2 * ((static_cast<double>(k) + 0.5 * half) / static_cast<double>(ramp_steps)));
    return s * s;
  }
};

/// Description of a sine that begins with compression (for a positive amplitude). Its amplitude may grow over a ramp.
struct CyclicSpec {
  static constexpr const char* name = "cyclic";
  double strain = 0;     ///< amplitude A
  double frequency = 0;  ///< [Hz]
  double ramp = 0;       ///< time in which the amplitude grows to A [s]

  template <class F>
  void each_key(F&& f) {
    f("strain", strain, ValueKind::strain, ValueNeed::required, "amplitude of the strain");
    f("frequency", frequency, ValueKind::frequency, ValueNeed::required, "frequency of the sine");
    f("ramp", ramp, ValueKind::pause, ValueNeed::optional, "time in which the amplitude grows");
  }
  std::optional<SpecFault> fault(double) const { return {}; }
  StrainRange range(double) const { return {-std::abs(strain), std::abs(strain)}; }
  double shortest_time(double) const { return 1 / (2 * std::numbers::pi * frequency); }
  double step(double largest, double) const { return dividing_step({1 / frequency, ramp}, largest); }
  std::shared_ptr<const Drive> drive(double unit, double dt, double) const {
    const std::int64_t steps = std::llround(1 / (frequency * dt));
    return std::make_shared<Cyclic>(unit * strain, frequency, steps, std::llround(ramp / dt));
  }
  /// During the ramp, the amplitude is A·r with r = ½·(1 − cos κt) and κ = π/ramp, so that −A·r·sin ωt is a sum of
  /// three sines.
  std::vector<RatePiece> pieces(double duration) const {
    const double w = 2 * std::numbers::pi * frequency;
    std::vector<RatePiece> out;
    if (ramp > 0) {
      const double k = std::numbers::pi / ramp;
      if (!append_piece(out, ramp, duration,
                        {{-0.5 * strain * w, w}, {0.25 * strain * (w + k), w + k}, {0.25 * strain * (w - k), w - k}}))
        return out;
    }
    append_piece(out, duration, duration,
                 {{-strain * w * std::polar(1.0, std::fmod(w * ramp, 2 * std::numbers::pi)), w}});
    return out;
  }
};

}  // namespace macadam::drives
