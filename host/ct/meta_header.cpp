// SPDX-License-Identifier: GPL-3.0-or-later
// meta_header.cpp  Lines `KEY = VALUE`, of which ElementDataFile is the last.
#include "host/ct/meta_header.hpp"

#include <charconv>
#include <fstream>
#include <string>
#include <string_view>

#include "host/in_quotes.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const std::size_t begin = text.find_first_not_of(blank);
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

}  // namespace

void check_meta_header(const std::filesystem::path& file) {
  constexpr std::size_t longest = 4096;     // bytes of a line
  constexpr int most = 1000;                // lines
  constexpr std::size_t longest_key = 254;  // ITK copies it into 255 bytes
  std::ifstream in(file, std::ios::binary);
  std::string line(longest, '\0');
  for (int number = 1; number <= most; ++number) {
    in.getline(line.data(), static_cast<std::streamsize>(longest));
    if (!in) break;
    const std::string_view text(line.data());
    const std::size_t sign = text.find('=');
    const std::string_view key = trimmed(text.substr(0, sign));
    if (key.empty() && sign == std::string_view::npos) continue;
    if (sign == std::string_view::npos)
      throw InputError(file.string(), number, "header of a MetaImage", in_quotes(text), "KEY = VALUE");
    if (key.size() > longest_key)
      throw InputError(file.string(), number, "header of a MetaImage",
                       "a key of " + std::to_string(key.size()) + " bytes",
                       std::to_string(longest_key) + " at the most");
    const std::string_view value = trimmed(text.substr(sign + 1));
    int dimensions = 0;
    if (key == "NDims" && (std::from_chars(value.data(), value.data() + value.size(), dimensions).ec != std::errc{} ||
                           dimensions < 2 || dimensions > 3))
      throw InputError(file.string(), number, "NDims", in_quotes(value), "two or three dimensions");
    if (key == "ElementDataFile") return;
  }
  throw InputError(file.string(), 0, "header of a MetaImage", "no line ElementDataFile", "one, at its end");
}

}  // namespace macadam::ct
