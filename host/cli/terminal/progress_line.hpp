// SPDX-License-Identifier: GPL-3.0-or-later
/// \file progress_line.hpp  Shows one line on a terminal: stage, fraction done, time left. Prints nothing if standard
/// error is not a terminal, or once the terminal has been closed.
#pragma once

#include <unistd.h>

#include <chrono>
#include <string>

#include "host/cli/terminal/streams.hpp"

namespace macadam {

/// The line on standard error. The destructor erases it.
class ProgressLine {
 public:
  ~ProgressLine() { clear(); }

  /// Redraws at most ten times per second. If the fraction is smaller than before, a new stage has begun. The time left
  /// is computed from the beginning of the stage.
  void show(const std::string& stage, double share) {
    if (!terminal_) return;
    const auto now = Clock::now();
    if (share < share_ || share == 0) stage_start_ = now;
    share_ = share;
    if (drawn_ && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    drawn_ = true;
    const double spent = std::chrono::duration<double>(now - stage_start_).count();
    const std::string left = share > 0.001 ? ", " + in_words(spent * (1 - share) / share) + " left" : "";
    terminal_ = say_error("\r\033[K{} {:.0f} %{}", stage, 100 * share, left);
  }

  /// Erases the line, so that other output may follow.
  void clear() {
    if (drawn_ && terminal_) terminal_ = say_error_text("\r\033[K");
    drawn_ = false;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static std::string in_words(double seconds) {
    if (seconds < 90) return fmt::format("{:.0f} s", seconds);
    if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
  }
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  bool drawn_ = false;
  double share_ = 2;
  Clock::time_point stage_start_ = Clock::now(), last_{};
};

}  // namespace macadam
