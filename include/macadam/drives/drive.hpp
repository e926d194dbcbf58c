// SPDX-License-Identifier: GPL-3.0-or-later
/// \file drive.hpp  Defines the interface of a drive: a displacement or a force of a wall as a function of the step
/// number.
#pragma once

#include <cstdint>

namespace macadam {

/// Prescribes a displacement [m] or a force [N] of a wall along one axis, at whole steps. The Boundary (boundary.hpp)
/// decides whether the values are displacements or forces. Steppers read drives on the host, in tables of some thousand
/// steps, so a drive of your own may take a microsecond per step. To add a drive, write a header here, a line in
/// all.hpp and a test.
class Drive {
 public:
  virtual ~Drive() = default;

  /// Returns the value at step k [m] or [N]. A displacement must be 0 at step 0, unless the run starts from a state of
  /// motion (StartState); such a run also asks for the value at step −1.
  virtual double value(std::int64_t k) const = 0;

  /// Returns the mean rate of a displacement between steps k and k + 1 [m/s]. Override this function if the difference
  /// of two values has a large rounding error.
  virtual double rate(std::int64_t k) const { return (value(k + 1) - value(k)) / dt(); }

  /// Returns the time step for which the drive is made [s].
  virtual double dt() const = 0;

  /// Returns the shortest time in which the value changes much [s]: a period, or the length of a ramp; ∞ if the value
  /// never changes much. Some runs take steps in blocks and update viscoelastic states only between blocks; the blocks
  /// are then much shorter than this time.
  virtual double shortest_time() const = 0;

  /// Returns whether the drive changes its form at step 0, for example by a ramp. A run that starts from a state of
  /// motion (StartState) accepts only drives that return false.
  virtual bool begins() const { return true; }

  /// Returns the largest absolute rate [m/s] or [N/s].
  virtual double fastest() const = 0;
};

}  // namespace macadam
