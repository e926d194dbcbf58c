// SPDX-License-Identifier: GPL-3.0-or-later
// stop_signals.cpp  The handler calls nothing that POSIX does not allow in one.
#include "host/cli/stop_signals.hpp"

#include <csignal>
#include <ctime>

namespace macadam {
namespace {

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
constexpr long echo_seconds = 2;

volatile std::sig_atomic_t asked = 0;
timespec asked_at;  ///< written before `asked`, with the signals blocked

extern "C" void ask_to_stop(int number) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (!asked) {
    asked_at = now;
    asked = 1;
  } else if (now.tv_sec - asked_at.tv_sec > echo_seconds) {
    std::signal(number, SIG_DFL);
    std::raise(number);  // blocked until this handler returns
  }
}

}  // namespace

void listen_to_stop_signals() {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = SA_RESTART;  // a write that is under way goes on
  for (const int number : signals) sigaddset(&action.sa_mask, number);
  for (const int number : signals) {
    struct sigaction before {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
}

bool stop_asked() { return asked != 0; }

}  // namespace macadam
