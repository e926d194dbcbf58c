// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sparing_save.hpp  summary.json while a run goes on.
#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "host/simulation/solution.hpp"

namespace macadam {

/// Saves as often as costs a tenth of the time at most: the text grows with the frequencies.
class SparingSave {
 public:
  explicit SparingSave(Saving save) : save_(std::move(save)) {}
  void operator()(const std::string& status) {
    if (Clock::now() - last_ < 10 * cost_) return;
    const auto start = Clock::now();
    save_(status);
    last_ = Clock::now();
    cost_ = last_ - start;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Saving save_;
  Clock::time_point last_{};
  Clock::duration cost_{};
};

}  // namespace macadam
