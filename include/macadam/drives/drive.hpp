// SPDX-License-Identifier: GPL-3.0-or-later
/// \file drive.hpp  The contract of a drive: a displacement or a force as a function of the step.
#pragma once

#include <cstdint>

namespace macadam {

/// What a wall does along one axis: a displacement [m] or a force [N] at whole steps. Whether it is one or the other is
/// said where it is used (boundary.hpp). Steppers ask for tables of some thousand steps at a time, on the host, so a
/// drive of your own may be as slow as a microsecond a step. To add one: a header here, a line in all.hpp, a test.
class Drive {
 public:
  virtual ~Drive() = default;

  /// At step k [m] or [N]. A displacement is 0 at step 0, unless a run starts from a state of motion, which asks for
  /// step −1 as well.
  virtual double value(std::int64_t k) const = 0;

  /// Mean rate between the steps k and k + 1 [m/s], of a displacement. To be overridden where the difference of two
  /// values cancels.
  virtual double rate(std::int64_t k) const { return (value(k + 1) - value(k)) / dt(); }

  /// The time step that it is made for [s].
  virtual double dt() const = 0;

  /// The shortest time in which it changes much [s]: a period, the length of a ramp; ∞ where it never does. Devices
  /// settle viscous laws many times within it.
  virtual double shortest_time() const = 0;

  /// Whether anything begins at step 0. A run from a state of motion needs drives that have always gone on so.
  virtual bool begins() const { return true; }

  /// Largest absolute rate [m/s] or [N/s].
  virtual double fastest() const = 0;
};

}  // namespace macadam
