// SPDX-License-Identifier: GPL-3.0-or-later
/// \file thread_choice.hpp  All threads, or one: whichever has been faster of late.
///
/// Threads wait for each other twice a step. Where other programs want the same cores, one that waits for a thread
/// without a core waits for milliseconds, and two threads become many times slower than one (measured beside a build on
/// two cores: twenty times). Results are the same bits for any number of threads, so the choice may change at any step.
#pragma once

#include <algorithm>
#include <cstdint>

namespace macadam::kernels {

class ThreadChoice {
 public:
  /// `all`: threads there are; `fixed`: whether all are always taken.
  ThreadChoice(int all, bool fixed) : all_(all), fixed_(fixed || all == 1) {}

  /// Threads to take next, and for how many steps at the most.
  struct Next {
    int threads;
    std::int64_t steps;
  };
  Next next() const {
    if (fixed_) return {all_, INT64_MAX};
    const double step = step_[one_thread()];
    const double seconds = on_trial() ? trial_seconds : round_seconds;
    return {one_thread() ? 1 : all_,
            step > 0 ? std::max<std::int64_t>(1, static_cast<std::int64_t>(seconds / step)) : 16};
  }

  /// What the steps of the last next() took.
  void took(std::int64_t steps, double seconds) {
    if (fixed_) return;
    double& step = step_[one_thread()];
    const double before = step;
    step = seconds / static_cast<double>(steps);
    if (!on_trial()) {
      until_trial_ -= seconds;
      const bool changed = before > 0 && (step > 1.5 * before || before > 1.5 * step);
      if (changed) until_trial_ = 0, pause_ = first_pause;  // somebody else has come or gone
      return;
    }
    const bool was = one_faster_;
    one_faster_ = step_[1] > 0 && step_[1] < step_[0];
    // a choice that stands is questioned ever more seldom, so that trials cost some hundredths at the most
    pause_ = one_faster_ == was ? std::min(2 * pause_, longest_pause) : first_pause;
    until_trial_ = std::max(pause_, 20 * seconds);
  }

 private:
  static constexpr double trial_seconds = 2e-3, round_seconds = 0.1, first_pause = 0.5, longest_pause = 60;

  bool on_trial() const { return until_trial_ <= 0; }
  bool one_thread() const { return one_faster_ != on_trial(); }

  int all_;
  bool fixed_, one_faster_ = false;
  double step_[2] = {0, 0};  ///< seconds a step with all threads, and with one
  double until_trial_ = first_pause, pause_ = first_pause;
};

}  // namespace macadam::kernels
