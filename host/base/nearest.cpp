// SPDX-License-Identifier: GPL-3.0-or-later
// nearest.cpp  Computes the distance between words as a number of edits. Letters are compared without case.
#include "host/base/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <optional>

namespace macadam {
namespace {

/// Number of letters of a word that are compared. A line of a damaged file may be very long, and the time of edits()
/// grows with the square of the length.
constexpr std::size_t longest = 64;

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Returns the smallest number of edits that turn a into b (optimal string alignment). An edit inserts, removes or
/// replaces one letter, or exchanges two neighbouring letters.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j] + (same_letter(a[i], b[j]) ? 0 : 1), row[j] + 1, last[j + 1] + 1});
      if (i > 0 && j > 0 && same_letter(a[i], b[j - 1]) && same_letter(a[i - 1], b[j])) {
        row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
      }
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last.back();
}

/// Returns the word without its leading hyphens.
std::string_view bare(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of('-'), word.size()));
  return word;
}

/// Returns the known word that begins with `word` if there is exactly one, otherwise nothing. The leading hyphens of
/// options are ignored.
std::optional<std::string> only_with_beginning(std::string_view word, const std::vector<std::string>& known) {
  const auto begins = [word = bare(word)](const std::string& k) { return !word.empty() && bare(k).starts_with(word); };
  if (std::count_if(known.begin(), known.end(), begins) != 1) return {};
  return *std::find_if(known.begin(), known.end(), begins);
}

}  // namespace

std::size_t letters_between(std::string_view a, std::string_view b) {
  return edits(a.substr(0, longest), b.substr(0, longest));
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  return *std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return letters_between(word, a) < letters_between(word, b);
  });
}

std::string expected_one_of(std::string_view word, const std::vector<std::string>& known) {
  word = word.substr(0, longest);
  std::optional<std::string> near = nearest(word, known);
  if (3 * letters_between(word, *near) > std::max(word.size(), near->size())) near = only_with_beginning(word, known);
  if (!near && known.size() == 1) return known.front();
  return near ? fmt::format("{} (the nearest of {})", *near, fmt::join(known, ", "))
              : fmt::format("one of {}", fmt::join(known, ", "));
}

}  // namespace macadam
