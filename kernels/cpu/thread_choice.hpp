// SPDX-License-Identifier: GPL-3.0-or-later
/// \file thread_choice.hpp  Takes steps with all threads or with one thread, whichever has been faster recently.
///
/// Threads wait for each other twice per step. If other programs use the same cores, a thread waits milliseconds for
/// another one that has no core, and two threads become many times slower than one (measured beside a build on two
/// cores: twenty times). Results are the same bits for any number of threads, so the choice may change at any step.
#pragma once

#include <algorithm>
#include <cstdint>

namespace macadam::kernels {

/// Measures steps with all threads and with one, and chooses the faster.
class ThreadChoice {
 public:
  /// `all`: number of threads; `fixed`: always use all of them.
  ThreadChoice(int all, bool fixed) : all_(all), fixed_(fixed || all == 1) {}

  /// Number of threads to use next, and the largest number of steps to take with them.
  struct Next {
    int threads;
    std::int64_t steps;
  };
  /// Returns the number of threads to use next, and the number of steps to take with them. From time to time this is a
  /// short trial of the other choice.
  Next next() const {
    if (fixed_) return {all_, INT64_MAX};
    const double step = step_[one_thread()];
    const double seconds = on_trial() ? trial_seconds : round_seconds;
    return {one_thread() ? 1 : all_,
            step > 0 ? std::max<std::int64_t>(1, static_cast<std::int64_t>(seconds / step)) : 16};
  }

  /// Reports how long the steps of the last next() took.
  void took(std::int64_t steps, double seconds) {
    if (fixed_) return;
    double& step = step_[one_thread()];
    const double before = step;
    step = seconds / static_cast<double>(steps);
    if (!on_trial()) {
      until_trial_ -= seconds;
      const bool changed = before > 0 && (step > 1.5 * before || before > 1.5 * step);
      if (changed) until_trial_ = 0, pause_ = first_pause;  // another program has started or ended
      return;
    }
    const bool was = one_faster_;
    one_faster_ = step_[1] > 0 && step_[1] < step_[0];
    // as long as one choice remains the faster one, trials of the other become rarer; so trials cost a few per cent at
    // most
    pause_ = one_faster_ == was ? std::min(2 * pause_, longest_pause) : first_pause;
    until_trial_ = std::max(pause_, 20 * seconds);
  }

 private:
  static constexpr double trial_seconds = 2e-3, round_seconds = 0.1, first_pause = 0.5, longest_pause = 60;

  bool on_trial() const { return until_trial_ <= 0; }
  bool one_thread() const { return one_faster_ != on_trial(); }

  int all_;
  bool fixed_, one_faster_ = false;
  double step_[2] = {0, 0};  ///< seconds per step with all threads, and with one
  double until_trial_ = first_pause, pause_ = first_pause;
};

}  // namespace macadam::kernels
