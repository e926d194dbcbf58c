// SPDX-License-Identifier: GPL-3.0-or-later
// meta_header.cpp  Lines `KEY = VALUE` or `KEY: VALUE`, of which ElementDataFile is the last.
#include "host/ct/meta_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "host/in_quotes.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

bool is_control(char c) { return (static_cast<unsigned char>(c) < ' ' && c != '\t') || c == '\x7F'; }

bool is_copied(std::string_view key) {
  return key == "Comment" || key == "ObjectType" || key == "ObjectSubType" || key == "Name";
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t";
  const std::size_t begin = text.find_first_not_of(blank);
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

bool is_local(std::string_view value) { return value == "LOCAL" || value == "Local" || value == "local"; }

/// Not a list, nor a pattern, which ITK hands to printf whatever it holds, nor a folder, which ITK takes for a file.
bool is_one_file(const std::filesystem::path& folder, std::string_view value) {
  if (value.starts_with("LIST") || value.find('%') != std::string_view::npos) return false;
  const std::string name = (folder / value).string();
  std::error_code fault;  // a name that is too long, say
  return std::filesystem::is_regular_file(name, fault) || std::filesystem::is_regular_file(name + ".gz", fault) ||
         std::filesystem::is_regular_file(name + ".Z", fault);
}

}  // namespace

void check_meta_header(const std::filesystem::path& file) {
  constexpr std::size_t longest = 4096;  // bytes of a line
  constexpr int most = 1000;             // lines
  constexpr std::size_t copied = 254;    // bytes: ITK copies keys, and values of some, into 255
  std::ifstream in(file, std::ios::binary);
  std::string line(longest, '\0');
  bool value_to_come = false;  // ITK takes the next line for a value where there is none
  for (int number = 1; number <= most; ++number) {
    const auto refuse = [&](const std::string& found, const std::string& expected) {
      throw InputError(file.string(), number, "header of a MetaImage", found, expected);
    };
    in.getline(line.data(), static_cast<std::streamsize>(longest));
    if (!in) break;
    std::string_view text(line.data(), static_cast<std::size_t>(in.gcount() - (in.eof() ? 0 : 1)));  // less its end
    if (text.ends_with('\r')) text.remove_suffix(1);
    // ITK ends keys, values and numbers at some of them
    if (std::any_of(text.begin(), text.end(), is_control)) refuse(in_quotes(text), "text without control characters");
    const std::size_t sign = text.find_first_of("=:");
    const std::string_view key = trimmed(text.substr(0, sign));
    if (key.empty() && sign == std::string_view::npos) continue;
    if (sign == std::string_view::npos) refuse(in_quotes(text), "KEY = VALUE");
    const std::string_view value = trimmed(text.substr(sign + 1));
    for (const auto& [what, bytes] : {std::pair{"key", key.size()},
                                      {"value", is_copied(key) ? value.size() : 0},
                                      {"line", value_to_come ? text.size() : 0}})
      if (bytes > copied) refuse(fmt::format("a {} of {} bytes", what, bytes), fmt::format("{} at the most", copied));
    value_to_come = value.empty();
    if (key == "NDims" && value != "2" && value != "3")  // to ITK 3e9 is a number too, and too large for its arrays
      throw InputError(file.string(), number, "NDims", in_quotes(value), "two or three dimensions");
    if (key != "ElementDataFile") continue;
    if (!is_local(value) && !is_one_file(file.parent_path(), value))
      throw InputError(file.string(), number, "ElementDataFile", in_quotes(value),
                       "LOCAL or one file that is there (slices in files of their own: a folder of .tif)");
    return;
  }
  throw InputError(file.string(), 0, "header of a MetaImage", "no line ElementDataFile", "one, at its end");
}

}  // namespace macadam::ct
