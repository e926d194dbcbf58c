// SPDX-License-Identifier: GPL-3.0-or-later
// fault_signals.cpp  Handles the signals. The handler calls only functions that POSIX allows in a signal handler.
#include "host/cli/terminal/fault_signals.hpp"

#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <string_view>

namespace macadam {
namespace {

/// The handler has its own stack, because a full stack is one of the faults.
alignas(16) std::byte own_stack[1 << 16];

extern "C" void report_fault(int number) {
  constexpr std::string_view text =
      "macadam: ended by a fault of memory (signal SIGSEGV, SIGBUS, SIGILL or SIGFPE); this is an error of the "
      "program, "
      "or its library was replaced while it ran\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
  std::raise(number);  // SA_RESETHAND has restored the default, which ends the program when this handler returns
}

}  // namespace

void report_fault_signals() {
  stack_t stack{};
  stack.ss_sp = own_stack;
  stack.ss_size = sizeof own_stack;
  struct sigaction action {};
  action.sa_handler = report_fault;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  if (sigaltstack(&stack, nullptr) == 0) action.sa_flags |= SA_ONSTACK;
  for (const int number : {SIGSEGV, SIGBUS, SIGILL, SIGFPE}) {
    struct sigaction before {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler == SIG_DFL) sigaction(number, &action, nullptr);
  }
}

}  // namespace macadam
