// SPDX-License-Identifier: GPL-3.0-or-later
// meta_header.cpp  Parses lines `KEY = VALUE` or `KEY: VALUE`. The line ElementDataFile ends the header.
#include "host/tools/ct/images/meta_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <system_error>

#include "host/tools/ct/images/header_lines.hpp"
#include "host/base/in_quotes.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

// longest text [bytes]: ITK copies keys, and the values of some keys, into 255 bytes
constexpr std::size_t copied = 254;

/// Whether ITK copies the value of this key into 255 bytes.
bool is_copied(std::string_view key) {
  return key == "Comment" || key == "ObjectType" || key == "ObjectSubType" || key == "Name" || key == "AcquisitionDate";
}

/// Whether the value of ElementDataFile means that the voxels follow the header in the same file.
bool is_local(std::string_view value) { return value == "LOCAL" || value == "Local" || value == "local"; }

/// Whether the whole text is a number, which is stored in `number`.
bool is_number(std::string_view text, std::uintmax_t& number) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc{} && end == text.data() + text.size();
}

/// Checks one line. \throws InputError for a text too long for ITK, another number of dimensions than 2 or 3, and
/// voxels written as text.
void check(const HeaderLines& lines, std::string_view key, std::string_view value) {
  if (key.size() > copied)
    lines.refuse(fmt::format("a key of {} bytes", key.size()), fmt::format("at most {} bytes", copied));
  if (is_copied(key) && value.size() > copied)
    lines.refuse(fmt::format("{} of {} bytes", key, value.size()), fmt::format("at most {} bytes", copied));
  // compared as text: ITK would accept 3e9 as a number, which is too large for its arrays
  if (key == "NDims" && value != "2" && value != "3") lines.refuse(key, value, "two or three dimensions");
  // If the voxels are written as text and only some slices are read, ITK reads a wrong amount: one number for each byte
  // that binary voxels would have.
  if (key == "BinaryData" && !value.starts_with('T') && !value.starts_with('t') && !value.starts_with('1'))
    lines.refuse(key, value, "True, because voxels written as text are not read");
}

}  // namespace

HeaderFacts check_meta_header(const std::filesystem::path& file) {
  HeaderLines lines(file, "header of a MetaImage");
  bool copies_next = false;  // if a value is empty, some versions of ITK take the next line as the value
  std::uintmax_t packed = 0;
  HeaderFacts facts;
  while (const std::optional<std::string> line = lines.next()) {
    const std::size_t sign = std::min(line->find_first_of("=:"), line->size());
    const std::string_view text = *line, key = trimmed(text.substr(0, sign));
    if (key.empty() && sign == text.size()) continue;
    if (sign == text.size()) lines.refuse(in_quotes(text), "KEY = VALUE");
    if (copies_next && text.size() > copied)
      lines.refuse(fmt::format("a line of {} bytes behind a key without a value", text.size()),
                   fmt::format("at most {} bytes", copied));
    const std::string_view value = trimmed(text.substr(sign + 1));
    check(lines, key, value);
    copies_next = value.empty() && is_copied(key);
    if (key == "DistanceUnits" && value != "?") facts.take_unit(value);
    if (key == "CompressedDataSize" && !is_number(value, packed)) lines.refuse(key, value, "a whole number of bytes");
    if (key != "ElementDataFile") continue;
    // A LIST and a file name pattern are refused, because ITK would use their files without checking that they exist.
    // It would also expand the pattern with printf.
    if (value.starts_with("LIST") || value.find('%') != std::string_view::npos) lines.refuse_voxels(key, value);
    facts.voxels = is_local(value) ? file : lines.beside(key, value);
    if (const std::uintmax_t there = std::filesystem::file_size(facts.voxels);
        packed > there)  // because ITK allocates that many bytes
      throw InputError(file.string(), 0, "CompressedDataSize", fmt::format("{}", packed),
                       fmt::format("at most the {} bytes of {}", there, facts.voxels.filename().string()));
    return facts;
  }
  throw InputError(file.string(), 0, "header of a MetaImage", "no line ElementDataFile",
                   "this line at the end of the header");
}

}  // namespace macadam::ct
