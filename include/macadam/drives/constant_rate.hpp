// SPDX-License-Identifier: GPL-3.0-or-later
/// \file constant_rate.hpp  Defines a displacement or a force that grows linearly, for monotonic tests.
#pragma once

#include <algorithm>
#include <cmath>

#include "macadam/drives/drive.hpp"
#include "macadam/drives/spec.hpp"

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

/// Description of a strain that grows at a constant rate during the whole test.
struct ConstantRateSpec {
  static constexpr const char* name = "constant_rate";
  double rate = 0;  ///< [1/s]

  template <class F>
  void each_key(F&& f) {
    f("rate", rate, ValueKind::rate, ValueNeed::required, "rate of the strain");
  }
  std::optional<SpecFault> fault(double) const { return {}; }
  StrainRange range(double duration) const { return {std::min(0.0, rate * duration), std::max(0.0, rate * duration)}; }
  double shortest_time(double duration) const { return duration; }
  double step(double largest, double duration) const { return dividing_step({duration}, largest); }
  std::shared_ptr<const Drive> drive(double unit, double dt, double duration) const {
    return std::make_shared<ConstantRate>(unit * rate, dt, duration);
  }
  std::vector<RatePiece> pieces(double duration) const { return {{0, duration, {{rate, 0}}}}; }
};

}  // namespace macadam::drives
