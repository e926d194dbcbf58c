// SPDX-License-Identifier: GPL-3.0-or-later
/// \file piecewise_stepper.hpp  Takes the steps of a long run in pieces of some tenths of a second, so that the run can
/// react to a signal between two pieces.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "macadam/stepper.hpp"

namespace macadam {

/// Advances a stepper in pieces that take 0.1 to 0.4 s of wall time, however long a step takes. The first piece has 16
/// steps; the number is doubled after a piece that took less than 0.1 s, and halved after a piece that took more than
/// 0.4 s. Results do not depend on the length of the pieces, to the last bit. In a run of several processes, all
/// processes take the same pieces.
class PiecewiseStepper {
 public:
  /// The stepper must outlive this object.
  explicit PiecewiseStepper(Stepper& stepper) : stepper_(stepper) {}

  /// Takes the steps from step `from` up to step `to`, and calls look(step) with the number of the step reached after
  /// each piece. If look() throws, no further steps are taken, and the stepper is at a whole step.
  void advance(std::int64_t from, std::int64_t to, const std::function<void(std::int64_t step)>& look);

  /// Takes the steps up to the next sample, at step `to`. If several samples fit into one piece, also takes the steps
  /// to the samples that follow at the same distance, at most `times` of them. Returns the samples at all these steps,
  /// at least one. look() is not called after the last of these steps.
  std::vector<Sample> sample(std::int64_t from, std::int64_t to, std::int64_t times,
                             const std::function<void(std::int64_t step)>& look);

 private:
  /// Calls take(), which takes steps and returns their number, and adapts the size of a piece to the time that it took.
  void take_timed(const std::function<std::int64_t()>& take);

  Stepper& stepper_;
  std::int64_t piece_ = 16;  ///< steps of the next piece
};

}  // namespace macadam
