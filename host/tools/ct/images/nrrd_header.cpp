// SPDX-License-Identifier: GPL-3.0-or-later
// nrrd_header.cpp  Parses lines `FIELD: VALUE` up to the first empty line.
#include "host/tools/ct/images/nrrd_header.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <string>

#include "host/tools/ct/images/header_lines.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// Whether all words are whole numbers from 1 to 2³¹ − 1, which ITK stores without loss.
bool are_sizes(std::string_view text) {
  constexpr std::int64_t most = 2147483647;
  std::istringstream in{std::string(text)};
  for (std::string word; in >> word;) {
    std::int64_t size = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), size);
    if (fault != std::errc{} || end != word.data() + word.size() || size < 1 || size > most) return false;
  }
  return true;
}

/// Whether the text contains `%`, digits, `d`, which ITK replaces by the number of a file.
bool is_pattern(std::string_view text) {
  for (std::size_t at = text.find('%'); at < text.size(); at = text.find('%', at + 1)) {
    const std::size_t behind = text.find_first_not_of("0123456789", at + 1);
    if (behind < text.size() && text[behind] == 'd') return true;
  }
  return false;
}

/// Returns the field name in the form in which ITK compares it: lower case, without blanks.
std::string name_of(std::string_view field) {
  std::string out(field);
  std::erase(out, ' ');
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

/// Returns the unit in a list such as `"um" "um" "um"`; nothing if the list names none. If the axes have different
/// units, returns both names, which is not a known unit.
std::optional<std::string> unit_in(std::string_view list) {
  std::optional<std::string> unit;
  for (;;) {
    const std::size_t begin = list.find('"'), end = begin < list.size() ? list.find('"', begin + 1) : begin;
    if (end >= list.size()) return unit;
    const std::string name(trimmed(list.substr(begin + 1, end - begin - 1)));
    if (!name.empty() && unit && *unit != name) return *unit + ", " + name;
    if (!name.empty()) unit = name;
    list.remove_prefix(end + 1);
  }
}

}  // namespace

HeaderFacts check_nrrd_header(const std::filesystem::path& file) {
  HeaderLines lines(file, "header of an NRRD file");
  HeaderFacts facts;
  facts.voxels = file;
  bool raw = false, skips_to_end = false;
  while (const std::optional<std::string> line = lines.next()) {
    if (line->empty()) break;
    const std::size_t sign = line->find(':');
    if (sign == std::string::npos || line->front() == '#' || line->substr(sign, 2) == ":=") continue;
    const std::string_view text = *line, field = trimmed(text.substr(0, sign)), value = trimmed(text.substr(sign + 1));
    const std::string name = name_of(field);
    if (name == "sizes" && !are_sizes(value)) lines.refuse(field, value, "whole numbers from 1 to 2147483647");
    if (name == "encoding") raw = name_of(value) == "raw";
    if (name == "byteskip") skips_to_end = value.starts_with('-');
    if (name == "spaceunits" || name == "units") {
      if (const std::optional<std::string> unit = unit_in(value)) facts.take_unit(*unit);
    }
    if (name != "datafile") continue;
    if (value.starts_with("LIST") || is_pattern(value)) lines.refuse_voxels(field, value);
    facts.voxels = lines.beside(field, value);
  }
  if (skips_to_end && !raw)  // ITK would decompress everything to find the end
    throw InputError(file.string(), 0, "byte skip", "a negative value with an encoding that is not raw",
                     "encoding: raw");
  return facts;
}

}  // namespace macadam::ct
