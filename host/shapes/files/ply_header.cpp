// SPDX-License-Identifier: GPL-3.0-or-later
// ply_header.cpp  Reads the lines up to `end_header`: the format, the elements and their properties.
#include "host/shapes/files/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/base/in_quotes.hpp"
#include "host/shapes/files/surface_words.hpp"

namespace macadam {
namespace {

constexpr PlyType types[] = {{"char", "int8", 1, -128, 127},
                             {"uchar", "uint8", 1, 0, 255},
                             {"short", "int16", 2, -32768, 32767},
                             {"ushort", "uint16", 2, 0, 65535},
                             {"int", "int32", 4, -2147483648.0, 2147483647},
                             {"uint", "uint32", 4, 0, 4294967295},
                             {"float", "float32", 4, 0, 0},
                             {"double", "float64", 8, 0, 0}};

const PlyType* type_of(std::string_view word, const Words& words) {
  for (const PlyType& type : types)
    if (word == type.name || word == type.other_name) return &type;
  words.fail("type", in_quotes(word), "char, uchar, short, ushort, int, uint, float, double, or int8 to float64");
}

/// Reads the rest of a `property` line.
PlyProperty property_line(Words& words) {
  PlyProperty property{{}, nullptr, nullptr, words.line()};
  const std::string_view first = words.in_line();
  if (first == "list") {
    property.count = type_of(words.in_line(), words);
    if (!property.count->is_integer())
      words.fail("length of a list", in_quotes(property.count->name), "a type of whole numbers");
  }
  property.type = type_of(property.count ? words.in_line() : first, words);
  property.name = words.in_line();
  if (property.name.empty()) words.fail("property", "no name", "a name");
  return property;
}

/// Reads the rest of a `format` line.
void format_line(Words& words, PlyHeader& header) {
  const std::string_view format = words.in_line();
  header.text = format == "ascii", header.big_endian = format == "binary_big_endian";
  if (!header.text && !header.big_endian && format != "binary_little_endian")
    words.fail("format", in_quotes(format), "ascii, binary_little_endian or binary_big_endian");
}

/// Returns the smallest number of bytes that an item of the element takes. In text each number takes a digit and a
/// blank.
std::size_t least_bytes(const PlyElement& element, bool text) {
  std::size_t bytes = 0;
  for (const PlyProperty& p : element.properties) bytes += text ? 2 : (p.count ? p.count : p.type)->bytes;
  return bytes;
}

/// Refuses item counts that the file cannot hold, before memory is allocated for them.
void require_room(const SurfaceFile& file, const PlyHeader& header) {
  std::size_t room = file.bytes.size() - header.end + 1;  // plus 1: no blank is needed after the last number of a text
  for (const PlyElement& element : header.elements) {
    const std::size_t least = least_bytes(element, header.text);
    if (least > 0 && element.items > room / least)
      file.fail(element.line, "element " + element.name, fmt::format("{} items", element.items),
                fmt::format("fewer items, because only {} bytes follow the header", file.bytes.size() - header.end));
    room -= least * element.items;
  }
}

}  // namespace

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  const auto found =
      std::find_if(properties.begin(), properties.end(), [&](const PlyProperty& p) { return p.name == property; });
  if (found == properties.end()) return {};
  return static_cast<std::size_t>(found - properties.begin());
}

PlyHeader read_ply_header(const SurfaceFile& file) {
  PlyHeader header;
  Words words(file);
  if (words.next("ply") != "ply") words.fail("header", "no `ply`", "the word `ply`, with which a .ply file begins");
  bool format = false;
  for (;;) {
    words.skip_line();
    const std::string_view keyword = words.next("end_header");
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "end_header") break;
    if (keyword == "format") {
      format_line(words, header);
      format = true;
    } else if (keyword == "element") {
      const std::string name(words.in_line());
      header.elements.push_back({name, words.count(words.in_line(), "element " + in_quotes(name)), {}, words.line()});
    } else if (keyword == "property") {
      if (header.elements.empty()) words.fail("header", "a property before any element", "a complete .ply file");
      PlyProperty property = property_line(words);
      if (header.elements.back().find(property.name))
        words.fail("property", in_quotes(property.name) + " again", "each property once");
      header.elements.back().properties.push_back(std::move(property));
    } else {
      words.fail("header", in_quotes(keyword), "format, element, property, comment, obj_info or end_header");
    }
  }
  if (!format) words.fail("header", "no format", "ascii, binary_little_endian or binary_big_endian");
  header.lines = words.line();
  header.end = words.next_byte();
  require_room(file, header);
  return header;
}

}  // namespace macadam
