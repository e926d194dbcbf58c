// SPDX-License-Identifier: GPL-3.0-or-later
// nearest.cpp  Levenshtein's distance, letters compared without case.
#include "host/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace macadam {
namespace {

std::size_t edits(std::string_view a, std::string_view b) {  // Levenshtein, one row at a time
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::size_t letters_between(std::string_view a, std::string_view b) {
  constexpr std::size_t longest = 64;  // a line of a damaged file may be far longer, and edits() takes its time
  return edits(a.substr(0, longest), b.substr(0, longest));
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  return *std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return letters_between(word, a) < letters_between(word, b);
  });
}

}  // namespace macadam
