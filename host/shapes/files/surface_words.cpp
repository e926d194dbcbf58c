// SPDX-License-Identifier: GPL-3.0-or-later
// surface_words.cpp  Splits text into words, which end at white space. A word is a number only if the whole word is
// parsed, so "1.5.5" is not a number.
#include "host/shapes/files/surface_words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "host/base/in_quotes.hpp"

namespace macadam {
namespace {

constexpr std::string_view blank = " \t\r\n\v\f";  // contains \r: lines that end with \r\n are split at \n

std::string_view without_leading_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blank), text.size()));
  return text;
}

/// Parses the whole word into `value`; returns false if the word is not a number. Skips a leading plus sign, which
/// std::from_chars does not accept.
template <class T>
bool parse(std::string_view word, T& value) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace

Words::Words(const SurfaceFile& file, char comment, std::size_t from, int line)
    : file_(file), rest_(file.bytes.substr(from)), comment_(comment), next_number_(line) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (from == 0 && rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  const std::size_t end = file.bytes.find_first_of("\r\n");
  if (end != std::string_view::npos && file.bytes[end] == '\r' && file.bytes.substr(end + 1, 1) != "\n")
    line_end_ = '\r';
}

bool Words::take_line() {
  if (rest_.empty()) {
    line_ = {};
    return false;
  }
  const std::size_t end = std::min(rest_.find(line_end_), rest_.size());
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  number_ = next_number_++;
  if (comment_) line_ = line_.substr(0, line_.find(comment_));
  line_ = without_leading_blanks(line_);
  return true;
}

bool Words::next_line() {
  continued_ = false;
  while (take_line()) {
    if (!line_.empty()) return true;
  }
  return false;
}

std::string_view Words::in_line() {
  for (;;) {
    if (std::exchange(continued_, false)) take_line();
    line_ = without_leading_blanks(line_);
    std::string_view word = line_.substr(0, std::min(line_.find_first_of(blank), line_.size()));
    line_.remove_prefix(word.size());
    if (!continuation_ || !word.ends_with(continuation_) || !without_leading_blanks(line_).empty()) return word;
    continued_ = true;
    word.remove_suffix(1);
    if (!word.empty()) return word;
  }
}

std::string_view Words::next(const std::string& what) {
  std::string_view word = in_line();
  while (word.empty()) {
    if (!next_line()) fail("surface", "the end of the file", what);
    word = in_line();
  }
  return word;
}

double Words::any_number(std::string_view word, const std::string& what) const {
  double value = 0;
  if (!parse(word, value)) fail(what, word.empty() ? "the end of the line" : in_quotes(word), "a number");
  return value;
}

double Words::number(std::string_view word, const std::string& what) const {
  const double value = any_number(word, what);
  if (!std::isfinite(value)) fail(what, in_quotes(word), "a finite number");
  return value;
}

std::int64_t Words::integer(std::string_view word, const std::string& what) const {
  std::int64_t value = 0;
  if (!parse(word, value)) fail(what, word.empty() ? "the end of the line" : in_quotes(word), "a whole number");
  return value;
}

std::size_t Words::count(std::string_view word, const std::string& what) const {
  const std::int64_t value = integer(word, what);
  if (value < 0) fail(what, in_quotes(word), "a number of 0 or more");
  return static_cast<std::size_t>(value);
}

}  // namespace macadam
