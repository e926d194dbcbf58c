// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_words.hpp  The words of a surface's text, each with its line, and the numbers that they are.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/shapes/surface_readers.hpp"

namespace macadam {

/// Walks through the text of a file, by lines or by words.
class Words {
 public:
  /// Begins with the byte `from`, which is on line number `line`. What follows `comment` on its line is no word; 0:
  /// there are no comments.
  explicit Words(const SurfaceFile& file, char comment = 0, std::size_t from = 0, int line = 1)
      : file_(file), rest_(file.bytes.substr(from)), comment_(comment), next_number_(line) {}

  /// Goes to the next line that has a word; false where the text ends.
  bool next_line();
  /// The next word of this line; empty at its end.
  std::string_view in_line();
  /// The next word of the text, on whichever line. \throws InputError where the text ends; `what` was expected.
  std::string_view next(const std::string& what);
  /// Leaves out what is left of this line.
  void skip_line() { line_ = {}; }

  /// A word as a number, which may be infinite or none. \throws InputError naming its line.
  double any_number(std::string_view word, const std::string& what) const;
  /// A word as a finite number. \throws InputError naming its line.
  double number(std::string_view word, const std::string& what) const;
  /// A word as a whole number. \throws InputError naming its line.
  std::int64_t integer(std::string_view word, const std::string& what) const;
  /// The same, of 0 or more.
  std::size_t count(std::string_view word, const std::string& what) const;

  /// The first byte after this line.
  std::size_t next_byte() const { return file_.bytes.size() - rest_.size(); }
  /// Number of the line of the last word.
  int line() const { return number_; }
  [[noreturn]] void fail(const std::string& what, const std::string& found, const std::string& expected) const {
    file_.fail(number_, what, found, expected);
  }

 private:
  const SurfaceFile& file_;
  std::string_view rest_, line_;
  char comment_;
  int number_ = 0, next_number_;
};

}  // namespace macadam
