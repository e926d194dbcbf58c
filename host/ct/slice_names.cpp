// SPDX-License-Identifier: GPL-3.0-or-later
// slice_names.cpp  Gaps in the numbers of slices.
#include "host/ct/slice_names.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>

#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// The last number in a file's name, its ending left out.
std::optional<std::int64_t> number_of(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  const std::size_t last = name.find_last_of("0123456789");
  if (last == std::string::npos) return std::nullopt;
  const std::size_t before = name.find_last_not_of("0123456789", last), first = before + 1;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(name.data() + first, name.data() + last + 1, number);
  return error == std::errc{} ? std::optional(number) : std::nullopt;
}

}  // namespace

void check_slice_numbers(const std::vector<std::filesystem::path>& slices) {
  std::vector<std::int64_t> numbers;
  for (const std::filesystem::path& slice : slices) {
    const std::optional<std::int64_t> number = number_of(slice);
    if (!number) return;
    numbers.push_back(*number);
  }
  std::int64_t step = std::numeric_limits<std::int64_t>::max();
  for (std::size_t k = 1; k < numbers.size(); ++k) step = std::min(step, numbers[k] - numbers[k - 1]);
  if (numbers.size() < 2 || step <= 0) return;
  for (std::size_t k = 1; k < numbers.size(); ++k) {
    if (numbers[k] - numbers[k - 1] == step) continue;
    throw InputError(slices[k].parent_path().string(), 0, "slices",
                     slices[k].filename().string() + " after " + slices[k - 1].filename().string(),
                     "numbers that rise by " + std::to_string(step) + ": a slice is missing");
  }
}

}  // namespace macadam::ct
