// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ramp.hpp  Defines a ramp from 0 to a value, a hold and, if requested, a ramp back to 0, for relaxation, creep
/// and recovery.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "macadam/drives/drive.hpp"
#include "macadam/drives/spec.hpp"

namespace macadam::drives {

/// Rises over `ramp_steps` (at least one step; one step is a jump), holds for `hold_steps`, and falls to 0 over
/// `ramp_steps`.
struct Ramp final : Drive {
  static constexpr std::int64_t forever = std::numeric_limits<std::int64_t>::max();
  double height = 0;            ///< value during the hold [m] or [N]
  double step = 0;              ///< Δt [s]
  std::int64_t ramp_steps = 1;  ///< at least 1
  std::int64_t hold_steps = forever;
  bool smooth = false;  ///< whether the ramp is a half cosine, which causes smaller waves than a line

  Ramp() = default;
  Ramp(double height, double step, std::int64_t ramp_steps = 1, std::int64_t hold_steps = forever, bool smooth = false)
      : height(height), step(step), ramp_steps(ramp_steps), hold_steps(hold_steps), smooth(smooth) {}

  double dt() const override { return step; }
  double shortest_time() const override { return static_cast<double>(rise()) * step; }
  double fastest() const override { return std::abs(height) / shortest_time() * (smooth ? std::numbers::pi / 2 : 1.0); }
  double value(std::int64_t k) const override {
    if (k <= 0) return 0;
    if (k < rise()) return height * share(k);
    const std::int64_t held = k - rise();
    if (held <= hold_steps) return height;
    return height * (1 - share(std::min(held - hold_steps, rise())));
  }

 private:
  std::int64_t rise() const { return std::max<std::int64_t>(ramp_steps, 1); }
  double share(std::int64_t k) const {
    const double x = static_cast<double>(k) / static_cast<double>(rise());
    return smooth ? std::pow(std::sin(std::numbers::pi / 2 * x), 2) : x;
  }
};

/// Description of a ramp, a hold and, if the hold ends, a ramp back to 0.
struct RampSpec {
  static constexpr const char* name = "ramp";
  double strain = 0;           ///< during the hold
  double ramp = 0;             ///< duration of each ramp [s]
  std::optional<double> hold;  ///< [s]; empty: until the end of the test
  bool smooth = false;

  template <class F>
  void each_key(F&& f) {
    f("strain", strain, ValueKind::strain, ValueNeed::required, "strain that is held");
    f("ramp", ramp, ValueKind::pause, ValueNeed::required, "time in which the strain rises, and in which it falls");
    f("hold", hold, ValueKind::pause, ValueNeed::optional, "duration of the hold");
    f("smooth", smooth, ValueKind::number, ValueNeed::optional, "whether ramps are half cosines, not straight lines");
  }
  std::optional<SpecFault> fault(double) const {
    if (ramp > 0) return {};
    return SpecFault{"ramp", "0 with drive = \"ramp\"", "a positive number; kind \"relaxation\" has a sudden strain"};
  }
  StrainRange range(double) const { return {std::min(0.0, strain), std::max(0.0, strain)}; }
  double shortest_time(double) const { return ramp; }
  double step(double largest, double) const { return dividing_step({ramp, hold.value_or(0)}, largest); }
  std::shared_ptr<const Drive> drive(double unit, double dt, double) const {
    return std::make_shared<Ramp>(unit * strain, dt, std::llround(ramp / dt),
                                  hold ? std::llround(*hold / dt) : Ramp::forever, smooth);
  }
  /// The rate of a half cosine is strain·π/(2·ramp)·sin(πu/ramp).
  std::vector<RatePiece> pieces(double duration) const {
    const double speed = strain / ramp, k = std::numbers::pi / ramp;
    const RateWave rise = smooth ? RateWave{{0, -0.5 * strain * k}, k} : RateWave{speed, 0};
    std::vector<RatePiece> out;
    if (!append_piece(out, ramp, duration, {rise})) return out;
    if (!append_piece(out, hold ? ramp + *hold : duration, duration, {})) return out;
    if (!append_piece(out, 2 * ramp + *hold, duration, {{-rise.amplitude, rise.omega}})) return out;
    append_piece(out, duration, duration, {});
    return out;
  }
};

}  // namespace macadam::drives
