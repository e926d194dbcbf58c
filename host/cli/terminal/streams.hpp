// SPDX-License-Identifier: GPL-3.0-or-later
/// \file streams.hpp  Writes to standard output and error in any condition of these streams: closed, full, a pipe
/// without a reader, a closed terminal. Nothing here throws; flush_output() reports whether a write failed.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace macadam {

/// Opens closed standard streams on /dev/null. Otherwise a result file could get the number of a standard stream, and
/// printed text would go into it. Also ensures that a write to a pipe without a reader, or to a file beyond its size
/// limit, returns an error, as a write to a full disk does. By default such a write raises a signal that ends the
/// program. Must be called before any file is opened.
void hold_standard_streams();

/// Writes to standard output or, after say_to_standard_error(), to standard error.
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

/// Makes say() write to standard error from now on, because standard output is for another program.
void say_to_standard_error();

/// Discards standard output from now on.
void silence_output();

/// Empties the buffer of standard output. Returns whether everything that was ever printed was written.
bool flush_output();

}  // namespace macadam
