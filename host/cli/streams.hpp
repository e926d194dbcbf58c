// SPDX-License-Identifier: GPL-3.0-or-later
/// \file streams.hpp  Standard input, output and error in any condition: closed, full, a pipe that nobody reads, a
/// terminal that is gone. Nothing here throws; a failed write is remembered.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace macadam {

/// Must be called before anything is opened. Opens closed standard streams on /dev/null; otherwise a result file would
/// get the number of one, and with it what is printed. A pipe without a reader and a file beyond its size limit become
/// errors of the write, as a full disk is, instead of signals that end the program.
void hold_standard_streams();

/// Writes to standard output.
void say_text(const std::string& text);
/// Writes to standard error without allocating memory. Returns whether everything was written.
bool say_error_text(std::string_view text);

template <class... Args>
void say(fmt::format_string<Args...> text, Args&&... args) {
  say_text(fmt::format(text, std::forward<Args>(args)...));
}
template <class... Args>
bool say_error(fmt::format_string<Args...> text, Args&&... args) {
  return say_error_text(fmt::format(text, std::forward<Args>(args)...));
}

/// Discards standard output from now on.
void silence_output();

/// Empties the buffer of standard output. Returns whether everything that was ever printed was written.
bool flush_output();

}  // namespace macadam
