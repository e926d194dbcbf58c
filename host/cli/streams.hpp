// SPDX-License-Identifier: GPL-3.0-or-later
/// \file streams.hpp  Standard input, output and error as they come: closed, full, a pipe that nobody reads, a terminal
/// that is gone. Nothing here throws; what could not be written is remembered.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace macadam {

/// To be called before anything is opened. Closed standard streams are opened on nothing, or a result file would get
/// their number and with it what is printed. A pipe without a reader and a file beyond its size limit become errors of
/// the write, as a full disk is, in place of signals that end the program.
void hold_standard_streams();

/// Writes to standard output.
void say_text(const std::string& text);
/// Writes to standard error, without asking for memory. Whether it got there.
bool say_error_text(std::string_view text);

template <class... Args>
void say(fmt::format_string<Args...> text, Args&&... args) {
  say_text(fmt::format(text, std::forward<Args>(args)...));
}
template <class... Args>
bool say_error(fmt::format_string<Args...> text, Args&&... args) {
  return say_error_text(fmt::format(text, std::forward<Args>(args)...));
}

/// From now on standard output goes nowhere.
void silence_output();

/// Empties the buffer of standard output. Whether all that was ever said got out.
bool flush_output();

}  // namespace macadam
