// SPDX-License-Identifier: GPL-3.0-or-later
// stop_signals.cpp  Handles the signals. The handler calls only functions that POSIX allows in a signal handler.
#include "host/cli/terminal/stop_signals.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace macadam {
namespace {

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
constexpr std::int64_t echo_ns = 2'000'000'000;

/// Time of the first signal on the monotonic clock [ns]; 0: none yet. Several threads may be in the handler at once.
std::atomic<std::int64_t> asked_at{0};
static_assert(std::atomic<std::int64_t>::is_always_lock_free, "a handler may wait for nothing");

extern "C" void ask_to_stop(int number) {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  const std::int64_t now = time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
  std::int64_t first = 0;
  if (asked_at.compare_exchange_strong(first, now) || now - first <= echo_ns) return;
  std::signal(number, SIG_DFL);
  std::raise(number);  // takes effect when this handler returns
}

}  // namespace

void listen_to_stop_signals() {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = SA_RESTART;  // a write that is under way continues
  for (const int number : signals) sigaddset(&action.sa_mask, number);
  for (const int number : signals) {
    struct sigaction before {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
}

bool stop_asked() { return asked_at != 0; }

}  // namespace macadam
