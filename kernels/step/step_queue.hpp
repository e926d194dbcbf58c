// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_queue.hpp  Enqueues the steps of an executor in parts, and fills the walls' table for each part.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernels/step/executor.hpp"
#include "kernels/step/wall_motion.hpp"

namespace macadam::kernels {

/// Counts the steps of an executor and enqueues them. The executor must outlive this object.
template <Executor Exec>
class StepQueue {
 public:
  using R = typename Exec::Policy::Particle;

  explicit StepQueue(Exec& exec) : exec_(exec) {}

  /// Number of the last enqueued step.
  std::int64_t step() const { return step_; }
  void set_step(std::int64_t step) { step_ = step; }

  /// Sets the motion of the walls. Returns its description, with the address of the table on the executor.
  WallMotion<R> set_walls(const Boundary& boundary) {
    wall_table_ = WallTable<R>(boundary);
    WallMotion<R> wall = wall_table_.motion();
    wall.table = exec_.wall_table(wall_table_.most_values());
    return wall;
  }

  /// Enqueues steps and waits for them.
  void advance(std::int64_t steps) {
    try {
      StepsToTake all{step_, step_ + steps};
      queue_until(all.end, all);
      exec_.wait();
    } catch (...) {  // thrown by a drive or by the device
      exec_.end_steps();
      throw;
    }
  }

  /// Takes `times` samples, one after every `every` steps, and calls take(step, sample) for each when all steps are
  /// done. `times` must be at most Exec::max_samples().
  template <class Take>
  void advance_sampled(std::int64_t every, std::int64_t times, Take&& take) {
    StepsToTake all{step_, step_ + every * times};
    try {
      for (std::int64_t k = 0; k < times; ++k) {
        queue_until(step_ + every, all);
        exec_.take_sample(static_cast<std::size_t>(k));
      }
      std::int64_t step = all.begin;
      for (const auto& sample : exec_.wait_for_samples(static_cast<std::size_t>(times))) take(step += every, sample);
    } catch (...) {
      exec_.end_steps();
      throw;
    }
  }

 private:
  /// Counts the steps that are enqueued in several parts, and the rows of the walls' table that are filled in for these
  /// steps.
  struct StepsToTake {
    std::int64_t begin, end, row = 0, rows = 0;
  };
  /// Enqueues steps up to number `to`, which is the end or, if samples are taken, any step before it.
  void queue_until(std::int64_t to, StepsToTake& all) {
    while (step_ < to) {
      if (all.row == all.rows) {
        all.rows = wall_table_.rows(step_ - all.begin, all.end - step_), all.row = 0;
        exec_.set_wall_rows(wall_table_.fill(step_, all.rows));
      }
      const std::int64_t n = std::min(to - step_, all.rows - all.row);
      exec_.run(step_, n, all.row);
      step_ += n, all.row += n;
    }
  }

  Exec& exec_;
  WallTable<R> wall_table_;
  std::int64_t step_ = 0;
};

}  // namespace macadam::kernels
