// SPDX-License-Identifier: GPL-3.0-or-later
// piecewise_stepper.cpp  Takes the steps of a run in pieces, and adapts the number of steps per piece to the measured
// wall time of a piece.
#include "macadam/piecewise_stepper.hpp"

#include <algorithm>
#include <chrono>

#include "macadam/ranks.hpp"

namespace macadam {

void PiecewiseStepper::advance(std::int64_t from, std::int64_t to, const std::function<void(std::int64_t)>& look) {
  while (from < to) {
    const std::int64_t steps = std::min(piece_, to - from);
    take_timed([&] {
      stepper_.advance(steps);
      return steps;
    });
    look(from += steps);
  }
}

std::vector<Sample> PiecewiseStepper::sample(std::int64_t from, std::int64_t to, std::int64_t times,
                                             const std::function<void(std::int64_t)>& look) {
  const std::int64_t before = std::max(from, to - piece_);
  advance(from, before, look);
  const std::int64_t steps = to - before;
  if (steps == 0) return {{stepper_.observe(), stepper_.first_divergent()}};
  const std::int64_t at_once = before == from ? std::min(1 + times, piece_ / steps) : 1;
  std::vector<Sample> out;
  take_timed([&] {
    out = stepper_.advance_sampled(steps, at_once);
    return steps * std::ssize(out);
  });
  return out;
}

void PiecewiseStepper::take_timed(const std::function<std::int64_t()>& take) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const std::int64_t steps = take();
  // All processes use the time that the first process has measured, so that they all take the same pieces.
  const double seconds = of_first_rank(std::chrono::duration<double>(Clock::now() - start).count());
  if (2 * steps > piece_ && seconds < 0.1) piece_ *= 2;
  if (seconds > 0.4) piece_ = std::max<std::int64_t>(1, piece_ / 2);
}

}  // namespace macadam
