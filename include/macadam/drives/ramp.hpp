// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ramp.hpp  Defines a ramp from 0 to a value, a hold and, if requested, a ramp back to 0, for relaxation, creep
/// and recovery.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "macadam/drives/drive.hpp"

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

}  // namespace macadam::drives
