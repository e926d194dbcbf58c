// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sparing_save.hpp  Saves summary.json during a run.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include "host/run/planned_experiment.hpp"

namespace macadam {

/// Saves summary.json only so often that saving takes at most a tenth of the wall time. This limit is needed because
/// the text grows with the number of frequencies, so each save takes longer.
class SparingSave {
 public:
  using Clock = std::chrono::steady_clock;
  /// \param now returns the time; tests pass a clock of their own
  explicit SparingSave(Saving save, std::function<Clock::time_point()> now = Clock::now)
      : save_(std::move(save)), now_(std::move(now)) {}
  void operator()(const std::string& status) {
    const auto start = now_();
    if (start - last_ < 10 * cost_) return;
    save_(status);
    last_ = now_();
    cost_ = last_ - start;
  }

 private:
  Saving save_;
  std::function<Clock::time_point()> now_;
  Clock::time_point last_{};
  Clock::duration cost_{};
};

}  // namespace macadam
