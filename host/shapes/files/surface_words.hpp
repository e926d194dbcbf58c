// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_words.hpp  Splits the text of a surface file into lines and words, keeps line numbers for messages,
/// and parses numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/shapes/files/surface_readers.hpp"

namespace macadam {

/// Walks through the text of a file by lines or by words. The class assumes that all lines end as the first line does:
/// with a line feed, with carriage return and line feed, or with a carriage return alone. A UTF-8 byte order mark is
/// skipped.
class Words {
 public:
  /// Starts at byte `from`, which is on line number `line`. The rest of a line after the character `comment` is
  /// skipped; 0 means that the text has no comments.
  explicit Words(const SurfaceFile& file, char comment = 0, std::size_t from = 0, int line = 1);

  /// Makes in_line() continue with the next line after a line whose last character is `sign`.
  void continue_lines_after(char sign) { continuation_ = sign; }

  /// Goes to the next line with words. Returns false at the end of the text.
  bool next_line();
  /// Returns the next word of this line, or an empty word at the end of the line.
  std::string_view in_line();
  /// Returns the next word of the text, on any line. \throws InputError at the end of the text, saying that `what` was
  /// expected.
  std::string_view next(const std::string& what);
  /// Skips the rest of this line.
  void skip_line() { line_ = {}; }
  /// Returns the number of characters left in this line.
  std::size_t left_in_line() const { return line_.size(); }
  /// Returns the number of characters left in the text.
  std::size_t left() const { return line_.size() + rest_.size(); }

  /// Parses one word as a number, which may be infinite or NaN. \throws InputError naming the line.
  double any_number(std::string_view word, const std::string& what) const;
  /// Parses one word as a finite number. \throws InputError naming the line.
  double number(std::string_view word, const std::string& what) const;
  /// Parses one word as an integer. \throws InputError naming the line.
  std::int64_t integer(std::string_view word, const std::string& what) const;
  /// Parses one word as an integer of at least 0. \throws InputError naming the line.
  std::size_t count(std::string_view word, const std::string& what) const;

  /// Returns the offset of the first byte after this line.
  std::size_t next_byte() const { return file_.bytes.size() - rest_.size(); }
  /// Returns the line number of the last word.
  int line() const { return number_; }
  [[noreturn]] void fail(const std::string& what, const std::string& found, const std::string& expected) const {
    file_.fail(number_, what, found, expected);
  }

 private:
  /// Goes to the next line, even if it is blank. Returns false at the end of the text.
  bool take_line();

  const SurfaceFile& file_;
  std::string_view rest_, line_;
  char comment_, line_end_ = '\n', continuation_ = 0;
  bool continued_ = false;  // the next line continues this one
  int number_ = 0, next_number_;
};

}  // namespace macadam
