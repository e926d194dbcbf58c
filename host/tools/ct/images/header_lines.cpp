// SPDX-License-Identifier: GPL-3.0-or-later
// header_lines.cpp  Reads header lines one at a time, so that a large file is never held in memory.
#include "host/tools/ct/images/header_lines.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/tools/ct/images/length_units.hpp"
#include "host/base/in_quotes.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

constexpr std::size_t longest = 65536;  // limit for one line including its end [bytes]

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t";
  const std::size_t begin = text.find_first_not_of(blank);
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

void HeaderFacts::take_unit(std::string_view name) {
  unit = metres_of_unit(name);
  if (!unit)
    notes.push_back("the file's lengths are in " + in_quotes(name) +
                    ", which is not a known unit, so these lengths are not used");
}

HeaderLines::HeaderLines(const std::filesystem::path& file, std::string what)
    : file_(file), what_(std::move(what)), buffer_(longest, '\0'), in_(file, std::ios::binary) {}

std::optional<std::string> HeaderLines::next() {
  in_.getline(buffer_.data(), static_cast<std::streamsize>(longest));
  const auto read = static_cast<std::size_t>(in_.gcount());
  ++number_;
  if (!in_ && read + 1 == longest) refuse(fmt::format("a line of {} bytes or more", longest - 1), "a shorter line");
  if (!in_) return {};
  std::string line(buffer_.data(), read - (in_.eof() ? 0 : 1));
  if (line.ends_with('\r')) line.pop_back();
  if (line.find_first_of(std::string_view("\0\r", 2)) != std::string::npos)
    refuse(in_quotes(line), "text without zero bytes and without carriage returns before the end of the line");
  return line;
}

void HeaderLines::refuse(const std::string& found, const std::string& expected) const {
  throw InputError(file_.string(), number_, what_, found, expected);
}

void HeaderLines::refuse(std::string_view key, std::string_view value, const std::string& expected) const {
  throw InputError(file_.string(), number_, std::string(key), in_quotes(value), expected);
}

std::filesystem::path HeaderLines::beside(std::string_view key, std::string_view value) const {
  const std::filesystem::path path = file_.parent_path() / value;
  std::error_code fault;  // set for example if the name is too long; such a file counts as missing
  if (value.empty() || !std::filesystem::is_regular_file(path, fault)) refuse_voxels(key, value);
  return path;
}

void HeaderLines::refuse_voxels(std::string_view key, std::string_view value) const {
  refuse(key, value, "one existing file; slices in separate files are read from a folder of .tif files");
}

}  // namespace macadam::ct
