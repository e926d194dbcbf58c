// SPDX-License-Identifier: GPL-3.0-or-later
// mutate.cpp  Mutates lines and cells of texts, with numbers that are difficult for readers.
#include "tests/fuzz/mutate.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace macadam::fuzz {
namespace {

constexpr const char* numbers[] = {"0",
                                   "-0",
                                   "1",
                                   "-1",
                                   "2",
                                   "3",
                                   "0.5",
                                   "1e-9",
                                   "1e9",
                                   "127",
                                   "128",
                                   "255",
                                   "256",
                                   "32768",
                                   "65536",
                                   "2147483647",
                                   "2147483648",
                                   "-2147483648",
                                   "4294967295",
                                   "4294967296",
                                   "9223372036854775807",
                                   "-9223372036854775808",
                                   "18446744073709551615",
                                   "18446744073709551616",
                                   "1e-300",
                                   "5e-324",
                                   "1e300",
                                   "1.7976931348623157e308",
                                   "1e309",
                                   "-1e308",
                                   "inf",
                                   "-inf",
                                   "nan",
                                   "+1",
                                   "+-1",
                                   "0x10",
                                   "1.5.5",
                                   "1,5"};

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    out.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return out;
}

/// Returns begin and length of each cell of a line.
std::vector<std::pair<std::size_t, std::size_t>> cells_of(std::string_view line, std::string_view separators) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t begin = 0; begin < line.size();) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    if (end > begin) out.emplace_back(begin, end - begin);
    begin = end + 1;
  }
  return out;
}

std::string a_word(Random& random, const std::vector<std::string>& words) {
  if (!words.empty() && below(random, 2) == 0) return words[below(random, words.size())];
  if (below(random, 3) > 0) return numbers[below(random, std::size(numbers))];
  return std::to_string(static_cast<double>(below(random, 2000)) / 1000 - 0.2);
}

void change_cell(std::string& line, Random& random, std::string_view separators,
                 const std::vector<std::string>& words) {
  const auto cells = cells_of(line, separators);
  if (cells.empty()) return;
  const auto [begin, length] = cells[below(random, cells.size())];
  switch (below(random, 5)) {
    case 0:
      line.erase(begin, length);
      break;
    case 1: {
      const auto [from, size] = cells[below(random, cells.size())];
      line.replace(begin, length, std::string(line, from, size));
      break;
    }
    case 2:
      line.insert(begin, a_word(random, words) + separators.front());
      break;
    default:
      line.replace(begin, length, a_word(random, words));
  }
}

}  // namespace

std::size_t below(Random& random, std::size_t end) { return random() % end; }

std::string changed_bytes(std::string text, std::size_t most) {
  const std::size_t size = std::min(text.size(), most);
  text.resize(most);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, most));
  return text;
}

std::string changed_cells(std::string_view text, Random& random, std::string_view separators,
                          const std::vector<std::string>& words) {
  std::vector<std::string> lines = lines_of(text);
  for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) {
    if (lines.empty()) lines.emplace_back(a_word(random, words) + "\n");
    const std::size_t at = below(random, lines.size()), other = below(random, lines.size());
    const auto place = [&](std::size_t line) { return lines.begin() + static_cast<std::ptrdiff_t>(line); };
    switch (below(random, 10)) {
      case 0:
        lines.erase(place(at));
        break;
      case 1:
        lines.insert(place(at), std::string(lines[other]));
        break;
      case 2:
        std::swap(lines[at], lines[other]);
        break;
      default:
        change_cell(lines[at], random, separators, words);
    }
  }
  std::string out;
  for (const std::string& line : lines) out += line;
  return out;
}

std::size_t mutate_cells(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                         std::string_view separators, const std::vector<std::string>& words) {
  Random random(seed);
  if (below(random, 3) == 0) return LLVMFuzzerMutate(data, size, most);
  return give_back(changed_cells({reinterpret_cast<const char*>(data), size}, random, separators, words), data, most);
}

std::size_t give_back(const std::string& text, std::uint8_t* data, std::size_t most) {
  const std::size_t size = std::min(text.size(), most);
  std::memcpy(data, text.data(), size);
  return size;
}

}  // namespace macadam::fuzz
