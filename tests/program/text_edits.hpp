// SPDX-License-Identifier: GPL-3.0-or-later
/// \file text_edits.hpp  Makes variants of a valid text, each with one change: another number, cell, line or value of a
/// key.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/program.hpp"

namespace macadam::test {

/// A changed text, with a description of the place and of the change.
struct TextEdit {
  std::string place, change, text;
};

namespace edits {

inline std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += line + '\n';
  return out;
}

/// Begin and length of a part of a line.
using Part = std::pair<std::size_t, std::size_t>;

/// Returns the numbers of a line with their signs. Numbers that are part of a word are left out.
inline std::vector<Part> numbers(const std::string& line) {
  std::vector<Part> out;
  const auto part_of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; };
  for (std::size_t at = 0; at < line.size();) {
    const char* const begin = line.c_str() + at;
    char* end = nullptr;
    const bool sign = *begin == '-' && std::isdigit(static_cast<unsigned char>(begin[1]));
    if ((at == 0 || !part_of_word(line[at - 1])) && (sign || std::isdigit(static_cast<unsigned char>(*begin))))
      std::strtod(begin, &end);
    if (end && end != begin && !part_of_word(*end)) {
      out.emplace_back(at, end - begin);
      at += static_cast<std::size_t>(end - begin);
    } else {
      ++at;
    }
  }
  return out;
}

/// Returns the parts of a line between separators, as table cells.
inline std::vector<Part> cells(const std::string& line, const std::string& separators) {
  std::vector<Part> out;
  std::size_t begin = 0;
  for (std::size_t at = 0; at <= line.size(); ++at) {
    if (at < line.size() && separators.find(line[at]) == std::string::npos) continue;
    if (at > begin || separators == ",") out.emplace_back(begin, at - begin);
    begin = at + 1;
  }
  return out;
}

/// Replaces one part at a time in the lines whose numbers are in `which`. Each part is replaced by every text of
/// `instead`, and by the preceding part of its line. Adds each changed text to `out`.
template <class PartsOf>
void replace_parts(std::vector<TextEdit>& out, const std::string& text, const std::vector<std::size_t>& which,
                   const std::vector<std::string>& instead, const PartsOf& parts_of) {
  const std::vector<std::string> all = lines_of(text);
  for (const std::size_t n : which) {
    std::size_t number = 0;
    std::string before;
    for (const auto& [begin, length] : parts_of(all[n])) {
      const std::string was = all[n].substr(begin, length);
      std::vector<std::string> with = instead;
      if (number > 0 && std::find(with.begin(), with.end(), before) == with.end()) with.push_back(before);
      before = was;
      ++number;
      for (const std::string& now : with) {
        if (now == was) continue;
        std::vector<std::string> changed = all;
        changed[n].replace(begin, length, now);
        out.push_back({fmt::format("line {}, {} of: {}", n + 1, number, all[n]), now, joined(changed)});
      }
    }
  }
}

/// Adds two texts for each line of `which`: one without the line, one with the line twice.
inline void replace_lines(std::vector<TextEdit>& out, const std::string& text, const std::vector<std::size_t>& which) {
  const std::vector<std::string> all = lines_of(text);
  for (const std::size_t n : which) {
    const std::string place = fmt::format("line {}: {}", n + 1, all[n]);
    std::vector<std::string> changed = all;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(n));
    out.push_back({place, "left out", joined(changed)});
    changed = all;
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(n), all[n]);
    out.push_back({place, "twice", joined(changed)});
  }
}

/// Adds to `out` one text for each of `values`, in which a key in a section of TOML has this value. If the text has the
/// key, also adds a text without it. The old value must be on one line.
inline void set_key(std::vector<TextEdit>& out, const std::string& text, const std::string& section,
                    const std::string& key, const std::vector<std::string>& values) {
  std::vector<std::string> all = lines_of(text);
  std::size_t at = 0;
  while (at < all.size() && all[at] != section) ++at;
  if (at == all.size()) all.push_back(section);
  std::size_t found = at + 1;
  while (found < all.size() && !all[found].starts_with('[') && !all[found].starts_with(key + " =")) ++found;
  const bool is_there = found < all.size() && !all[found].starts_with('[');
  const std::string place = section + ' ' + key;
  if (is_there) {
    std::vector<std::string> without = all;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(found));
    out.push_back({place, "left out", joined(without)});
  } else {
    found = at + 1;
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(found), "");
  }
  for (const std::string& value : values) {
    all[found] = key + " = " + value;
    out.push_back({place, value, joined(all)});
  }
}

}  // namespace edits
}  // namespace macadam::test
