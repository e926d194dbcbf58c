// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_words.hpp  The words of a surface's text, each with its line, and the numbers that they are.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/shapes/surface_readers.hpp"

namespace macadam {

/// Walks through the text of a file, by lines or by words. Lines end as the file's first line does: with a line feed,
/// with carriage return and line feed, or with a carriage return alone. A byte order mark of UTF-8 is passed over.
class Words {
 public:
  /// Begins with the byte `from`, which is on line number `line`. The rest of a line after the character `comment` is
  /// passed over; with 0 the text has no comments.
  explicit Words(const SurfaceFile& file, char comment = 0, std::size_t from = 0, int line = 1);

  /// From now on a line whose last character is `sign` goes on in the next line, as in_line() reads it.
  void continue_lines_after(char sign) { continuation_ = sign; }

  /// Goes to the next line that has a word; false where the text ends.
  bool next_line();
  /// The next word of this line; empty at its end.
  std::string_view in_line();
  /// The next word of the text, on whichever line. \throws InputError where the text ends; `what` was expected.
  std::string_view next(const std::string& what);
  /// Leaves out what is left of this line.
  void skip_line() { line_ = {}; }
  /// Number of characters that are left of this line.
  std::size_t left_in_line() const { return line_.size(); }
  /// Number of characters that are left of the text.
  std::size_t left() const { return line_.size() + rest_.size(); }

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
  /// Goes to the next line, which may be blank; false where the text ends.
  bool take_line();

  const SurfaceFile& file_;
  std::string_view rest_, line_;
  char comment_, line_end_ = '\n', continuation_ = 0;
  bool continued_ = false;  // the next line belongs to this one
  int number_ = 0, next_number_;
};

}  // namespace macadam
