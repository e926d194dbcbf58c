// SPDX-License-Identifier: GPL-3.0-or-later
/// \file constant_rate.hpp  Defines a displacement or a force that grows linearly, for monotonic tests.
#pragma once

#include <cmath>

#include "macadam/drives/drive.hpp"

namespace macadam::drives {

/// Value speed·t.
struct ConstantRate final : Drive {
  double speed = 0;     ///< [m/s] or [N/s]
  double step = 0;      ///< Δt [s]
  double duration = 0;  ///< duration of the whole test [s]

  ConstantRate() = default;
  ConstantRate(double speed, double step, double duration) : speed(speed), step(step), duration(duration) {}

  double dt() const override { return step; }
  double shortest_time() const override { return duration; }
  double fastest() const override { return std::abs(speed); }
  double value(std::int64_t k) const override { return speed * (static_cast<double>(k) * step); }
  double rate(std::int64_t) const override { return speed; }
};

}  // namespace macadam::drives
