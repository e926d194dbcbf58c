// SPDX-License-Identifier: GPL-3.0-or-later
// nrrd_header.cpp  Lines `FIELD: VALUE` up to an empty one.
#include "host/ct/nrrd_header.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "host/in_quotes.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// Whole numbers that ITK keeps whole.
bool are_sizes(const std::string& text) {
  constexpr std::int64_t most = 2147483647;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    std::int64_t size = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), size);
    if (fault != std::errc{} || end != word.data() + word.size() || size < 1 || size > most) return false;
  }
  return true;
}

}  // namespace

void check_nrrd_header(const std::filesystem::path& file) {
  constexpr std::size_t longest = 65536;  // bytes of a line
  std::ifstream in(file, std::ios::binary);
  std::string buffer(longest, '\0');
  for (int number = 1; in.getline(buffer.data(), longest); ++number) {
    std::string line(buffer.c_str());
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) return;
    const std::size_t sign = std::min(line.find(':'), line.size());
    std::string field = line.substr(0, sign), value = line.substr(std::min(sign + 1, line.size()));
    std::erase(field, ' ');
    std::transform(field.begin(), field.end(), field.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto refuse = [&](const std::string& expected) {
      throw InputError(file.string(), number, field, in_quotes(value), expected);
    };
    if (field == "sizes" && !are_sizes(value)) refuse("whole numbers from 1 to 2147483647");
    const bool names_files = field == "datafile";
    if (names_files && (value.find("LIST") != std::string::npos || value.find('%') != std::string::npos))
      refuse("one file (slices in files of their own: a folder of .tif)");
  }
  if (in.gcount() + 1 == static_cast<std::streamsize>(longest))
    throw InputError(file.string(), 0, "header of an NRRD file", "a line of more than 65535 bytes", "a shorter one");
}

}  // namespace macadam::ct
