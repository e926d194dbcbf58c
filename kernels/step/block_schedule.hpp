// SPDX-License-Identifier: GPL-3.0-or-later
/// \file block_schedule.hpp  Tracks where a run is within its blocks of steps (contacts update their viscoelastic
/// states between two blocks): the length of the current block, and how many of its steps have been taken.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/step/state_list.hpp"

namespace macadam::kernels {

/// Counts the steps of a run in blocks; the executor asks it when a block is due and how long it is.
class BlockSchedule {
 public:
  /// Resets for a new start. `steps`: steps per block, 0: no blocks; `to_observations`: blocks end at the steps at
  /// which a run is observed.
  void begin(int steps, bool to_observations) {
    steps_ = steps;
    to_observations_ = to_observations;
    begun_ = false;
    taken_ = length_ = 0;
  }
  /// Returns whether a block must begin before the next step.
  bool is_due() const { return steps_ > 0 && (taken_ == length_ || !begun_); }
  bool has_begun() const { return begun_; }
  /// Returns whether the next step is the first of its block.
  bool begins() const { return taken_ == 0; }
  /// Returns the number of steps of the block that ends; 0: no block ends.
  int ended() const { return begun_ ? taken_ : 0; }
  /// Returns the number of steps of the block that begins with step `first`. A steady start begins at step −1; its
  /// first block has one step, so that the following blocks end at the observations.
  int next(std::int64_t first) const {
    return !begun_ && to_observations_ && first < 0 ? static_cast<int>(-first) : steps_;
  }
  /// Begins a block of `steps` steps.
  void start(int steps) {
    begun_ = true;
    length_ = steps;
    taken_ = 0;
  }
  /// Returns how many steps of the block remain.
  std::int64_t left() const { return length_ - taken_; }
  void take(std::int64_t steps) { taken_ += static_cast<int>(steps); }

  /// Adds to the states of a checkpoint: whether a block has begun, its length, and how many of its steps are taken.
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
  // length_: number of steps of the current block; the first block may have another length than steps_
  int steps_ = 0, taken_ = 0, length_ = 0;
  bool begun_ = false, to_observations_ = false;
};

}  // namespace macadam::kernels
