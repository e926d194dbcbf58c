// SPDX-License-Identifier: GPL-3.0-or-later
// slice_names.cpp  Finds names outside the sequence, duplicate numbers, and gaps.
#include "host/tools/ct/images/slice_names.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "host/tools/ct/images/image_slices.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// Compares texts letter by letter, but digits as numbers: slice_2 comes before slice_10.
bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](const std::string& s, std::size_t& at) {
      while (at < s.size() && s[at] == '0') ++at;
      const std::size_t begin = at;
      while (at < s.size() && digit(s[at])) ++at;
      return s.substr(begin, at - begin);
    };
    const std::string x = number(a, i), y = number(b, j);
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

/// The parts of a file's name, without its ending.
struct Name {
  std::string pattern;                ///< the name with # in place of each number
  std::vector<std::int64_t> numbers;  ///< all numbers; empty also if one is too large
};

/// Splits a file name at its numbers. Returns an empty Name if a number has more than 18 digits.
Name name_of(const std::filesystem::path& file) {
  constexpr const char* digits = "0123456789";
  const std::string text = file.stem().string();
  Name name;
  for (std::size_t at = 0;;) {
    const std::size_t first = std::min(text.find_first_of(digits, at), text.size());
    name.pattern += text.substr(at, first - at);
    if (first == text.size()) return name;
    at = std::min(text.find_first_not_of(digits, first), text.size());
    if (at - first > 18) return {};
    name.pattern += '#';
    name.numbers.push_back(std::stoll(text.substr(first, at - first)));
  }
}

/// Checks that the names differ only in their numbers. \throws InputError if some files have no number, or if the text
/// around their numbers differs from most files: they are not slices of this stack.
void check_sequence(const std::vector<std::filesystem::path>& slices, const std::vector<Name>& names) {
  const auto key_of = [](const Name& name) { return name.numbers.empty() ? "no number" : name.pattern; };
  std::map<std::string, std::size_t> count;
  for (const Name& name : names) ++count[key_of(name)];
  if (count.size() < 2) return;
  const auto commonest = std::ranges::max_element(count, {}, [](const auto& one) { return one.second; });
  const auto example = [&](bool of_commonest) {
    const auto at =
        std::ranges::find_if(names, [&](const Name& n) { return (key_of(n) == commonest->first) == of_commonest; });
    return slices[static_cast<std::size_t>(at - names.begin())].filename().string();
  };
  const std::size_t others = slices.size() - commonest->second;
  throw InputError(slices.front().parent_path().string(), 0, "slices",
                   example(false) + (others > 1 ? " and " + std::to_string(others - 1) + " more" : "") + " beside " +
                       std::to_string(commonest->second) + " files such as " + example(true),
                   "the slices of one stack, numbered in one sequence; move other images to another folder");
}

/// Returns for each name the number that counts the slices. This is the only number in which the names differ or, if
/// they differ in several numbers, the last number of the name.
std::vector<std::int64_t> counted(const std::vector<Name>& names) {
  const std::vector<std::int64_t>& first = names.front().numbers;
  std::optional<std::size_t> column;
  bool unique = true;
  for (const Name& name : names) {
    if (name.numbers.size() != first.size()) unique = false;
    for (std::size_t c = 0; unique && c < first.size(); ++c) {
      if (name.numbers[c] == first[c]) continue;
      unique = !column || *column == c;
      column = c;
    }
  }
  std::vector<std::int64_t> out;
  for (const Name& name : names) out.push_back(unique && column ? name.numbers[*column] : name.numbers.back());
  return out;
}

/// Checks that the files, given in the order of their slices, form one complete stack. \throws InputError.
void check_slice_numbers(const std::vector<std::filesystem::path>& slices) {
  std::vector<Name> names;
  for (const std::filesystem::path& slice : slices) names.push_back(name_of(slice));
  check_sequence(slices, names);
  if (names.size() < 2 || names.front().numbers.empty()) return;
  const std::string folder = slices.front().parent_path().string();
  for (std::size_t k = 1; k < names.size(); ++k) {
    if (names[k].numbers == names[k - 1].numbers)
      throw InputError(
          folder, 0, "slices",
          slices[k].filename().string() + " and " + slices[k - 1].filename().string() + ", which have the same number",
          "one file for each number");
  }
  const std::vector<std::int64_t> numbers = counted(names);
  std::int64_t step = std::numeric_limits<std::int64_t>::max();
  for (std::size_t k = 1; k < numbers.size(); ++k) step = std::min(step, numbers[k] - numbers[k - 1]);
  if (step <= 0) return;
  for (std::size_t k = 1; k < numbers.size(); ++k) {
    if (numbers[k] - numbers[k - 1] == step) continue;
    throw InputError(folder, 0, "slices", slices[k].filename().string() + " after " + slices[k - 1].filename().string(),
                     "numbers that rise by " + std::to_string(step) + ": a slice is missing");
  }
}

}  // namespace

std::vector<std::filesystem::path> slices_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> slices;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_tiff(entry.path())) slices.push_back(entry.path());
  }
  if (slices.empty()) throw InputError(folder.string(), 0, "slices", "no .tif file", "a folder of .tif files");
  std::sort(slices.begin(), slices.end(),
            [](const auto& a, const auto& b) { return natural_less(a.filename().string(), b.filename().string()); });
  check_slice_numbers(slices);
  return slices;
}

}  // namespace macadam::ct
