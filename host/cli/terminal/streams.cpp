// SPDX-License-Identifier: GPL-3.0-or-later
// streams.cpp  Prints to standard output and error without crashing if a stream is closed, full, or a pipe without a
// reader.
#include "host/cli/terminal/streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>

namespace macadam {
namespace {

bool to_standard_error = false, silent = false;  ///< whether say() writes to standard error

}  // namespace

void hold_standard_streams() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(number, F_GETFD) >= 0) continue;
    // open() returns the lowest free number, which is this one. The file is opened in the wrong direction, so that
    // writing to a closed stream remains an error.
    if (::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY) != number) break;
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void say_text(const std::string& text) {
  if (!silent) std::fwrite(text.data(), 1, text.size(), to_standard_error ? stderr : stdout);
}

void say_to_standard_error() { to_standard_error = true; }

bool say_error_text(std::string_view text) {
  const bool whole = std::fwrite(text.data(), 1, text.size(), stderr) == text.size();
  return std::fflush(stderr) == 0 && whole;
}

void silence_output() {
  silent = true;
  if (!std::freopen("/dev/null", "w", stdout)) std::clearerr(stdout);
}

bool flush_output() {
  std::cout.flush();  // CLI11 writes its help to std::cout
  const bool flushed = std::fflush(stdout) == 0;
  return flushed && std::ferror(stdout) == 0 && std::cout.good();
}

}  // namespace macadam
