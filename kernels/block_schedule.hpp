// SPDX-License-Identifier: GPL-3.0-or-later
/// \file block_schedule.hpp  Where a run is among its blocks of steps.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/state_list.hpp"

namespace macadam::kernels {

class BlockSchedule {
 public:
  /// From a start on. `steps`: of a block, 0: there are none; `to_observations`: blocks end where a run is observed.
  void begin(int steps, bool to_observations) {
    steps_ = steps;
    to_observations_ = to_observations;
    begun_ = false;
    taken_ = length_ = 0;
  }
  /// Whether a block is to begin before the next step.
  bool is_due() const { return steps_ > 0 && (taken_ == length_ || !begun_); }
  bool has_begun() const { return begun_; }
  /// Whether the next step is the first of its block.
  bool begins() const { return taken_ == 0; }
  /// Steps of the block that ends, 0: none.
  int ended() const { return begun_ ? taken_ : 0; }
  /// Steps of the block that begins with step `first`. A steady start begins at step −1: a block of one step, and those
  /// that follow end at the observations.
  int next(std::int64_t first) const {
    return !begun_ && to_observations_ && first < 0 ? static_cast<int>(-first) : steps_;
  }
  void start(int steps) {
    begun_ = true;
    length_ = steps;
    taken_ = 0;
  }
  /// Steps of the block that are to come.
  std::int64_t left() const { return length_ - taken_; }
  void take(std::int64_t steps) { taken_ += static_cast<int>(steps); }

  void add_state(StateList& states) {
    states.add<std::int64_t>(
        "block", "1", 3,
        [this] {
          return std::vector<std::int64_t>{begun_, taken_, length_};
        },
        [this](const std::vector<std::int64_t>& values) {
          begun_ = values[0] != 0;
          taken_ = static_cast<int>(values[1]);
          length_ = static_cast<int>(values[2]);
        });
  }

 private:
  int steps_ = 0, taken_ = 0, length_ = 0;  // length_: of the block that runs, the first may be another
  bool begun_ = false, to_observations_ = false;
};

}  // namespace macadam::kernels
