// SPDX-License-Identifier: GPL-3.0-or-later
// read_ply.cpp  Reads points and facets from PLY files, text and binary. Other elements and properties are skipped.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "host/base/in_quotes.hpp"
#include "host/shapes/files/ply_header.hpp"
#include "host/shapes/files/surface_words.hpp"

namespace macadam {
namespace {

/// Reads the numbers after the header one after another, as text or as bytes.
class PlyNumbers {
 public:
  PlyNumbers(const SurfaceFile& file, const PlyHeader& header)
      : file_(file),
        text_(header.text),
        turned_(header.big_endian != (std::endian::native == std::endian::big)),
        words_(file, 0, header.end, header.lines + 1),
        rest_(file.bytes.substr(header.end)) {}

  /// Returns the next number. `what` names it in messages.
  double next(const PlyType& type, const std::string& what) {
    return text_ ? in_text(type, what) : in_bytes(type, what);
  }

  /// Reads the next number as the length of a list.
  std::size_t length(const PlyProperty& list, const std::string& what) {
    const double length = next(*list.count, what);
    if (length < 0) fail(what, fmt::format("{} entries in a list", length), "0 or more");
    return static_cast<std::size_t>(length);
  }

  /// Skips the value or list of a property.
  void pass(const PlyProperty& property, const std::string& what) {
    const std::size_t numbers = property.count ? length(property, what) : 1;
    if (!text_ && numbers > rest_.size() / property.type->bytes) ends(what);
    for (std::size_t k = 0; k < numbers; ++k) next(*property.type, what);
  }

  /// Returns the largest count of numbers of a type that the remaining bytes can hold.
  std::size_t most(const PlyType& type) const {
    // In a text file a number takes at least two characters, a digit and a separator; the last number needs no
    // separator.
    return text_ ? (words_.left() + 1) / 2 : rest_.size() / type.bytes;
  }

  /// Checks that the file ends here. \throws InputError if it has more content.
  void require_end() {
    if (text_ ? words_.next_line() : rest_.find_first_not_of(" \t\r\n") != std::string_view::npos)
      fail("surface", text_ ? in_quotes(words_.in_line()) : fmt::format("{} bytes more", rest_.size()),
           "the end of the file after the last element");
  }

  int line() const { return text_ ? words_.line() : 0; }
  [[noreturn]] void fail(const std::string& what, const std::string& found, const std::string& expected) const {
    file_.fail(line(), what, found, expected);
  }

 private:
  [[noreturn]] void ends(const std::string& what) const { fail(what, "the end of the file", "a complete .ply file"); }

  double in_text(const PlyType& type, const std::string& what) {
    const std::string_view word = words_.next(what);
    const double value = words_.any_number(word, what);
    if (type.is_integer() && !(value >= type.low && value <= type.high && value == std::floor(value)))
      fail(what, in_quotes(word),
           fmt::format("a whole number from {} to {}, because the type of the property is {}", type.low, type.high,
                       type.name));
    return type.bytes == sizeof(float) && !type.is_integer() ? static_cast<float>(value) : value;
  }

  double in_bytes(const PlyType& type, const std::string& what) {
    if (rest_.size() < type.bytes) ends(what);
    std::array<char, 8> bytes{};
    std::copy_n(rest_.begin(), type.bytes, bytes.begin());
    if (turned_) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.bytes));
    rest_.remove_prefix(type.bytes);
    const auto as = [&](auto value) {
      std::memcpy(&value, bytes.data(), sizeof value);
      return static_cast<double>(value);
    };
    if (!type.is_integer()) return type.bytes == sizeof(float) ? as(float{}) : as(double{});
    if (type.bytes == 1) return type.low < 0 ? as(std::int8_t{}) : as(std::uint8_t{});
    if (type.bytes == 2) return type.low < 0 ? as(std::int16_t{}) : as(std::uint16_t{});
    return type.low < 0 ? as(std::int32_t{}) : as(std::uint32_t{});
  }

  const SurfaceFile& file_;
  bool text_, turned_;
  Words words_;
  std::string_view rest_;
};

/// Reads the vertices and appends their coordinates.
void read_points(const SurfaceFile& file, const PlyElement& element, PlyNumbers& numbers, SurfaceSoup& soup) {
  std::array<std::size_t, 3> column{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name(1, "xyz"[k]);
    const auto found = element.find(name);
    if (!found) file.fail(element.line, "element " + element.name, "no property " + name, "x, y and z");
    const PlyProperty& property = element.properties[*found];
    if (property.count) file.fail(property.line, "property " + name, "a list", "a number");
    column[k] = *found;
  }
  for (std::size_t i = 0; i < element.items; ++i) {
    const std::string what = fmt::format("point {}", i);
    std::array<double, 3> x{};
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const auto k = static_cast<std::size_t>(std::find(column.begin(), column.end(), p) - column.begin());
      if (k == 3) {
        numbers.pass(element.properties[p], what);
        continue;
      }
      x[k] = numbers.next(*element.properties[p].type, what);
      if (!std::isfinite(x[k])) numbers.fail(what, fmt::format("coordinate {}", x[k]), "a finite coordinate");
    }
    soup.points.push_back({x[0], x[1], x[2]});
  }
}

/// Reads the faces and appends their corners.
void read_facets(const SurfaceFile& file, const PlyElement& element, PlyNumbers& numbers, SurfaceSoup& soup) {
  auto column = element.find("vertex_indices");
  if (!column) column = element.find("vertex_index");
  if (!column) file.fail(element.line, "element " + element.name, "no property vertex_indices", "a list of that name");
  const PlyProperty& corners = element.properties[*column];
  if (!corners.count || !corners.type->is_integer())
    file.fail(corners.line, "property " + corners.name,
              corners.count ? fmt::format("a list of {}", corners.type->name) : "no list", "a list of whole numbers");
  for (std::size_t i = 0; i < element.items; ++i) {
    const std::string what = fmt::format("facet {}", i);
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (p != *column) {
        numbers.pass(element.properties[p], what);
        continue;
      }
      const std::size_t length = numbers.length(corners, what);
      if (length < 3) numbers.fail(what, fmt::format("{} points", length), "3 or more");
      if (length > numbers.most(*corners.type))
        numbers.fail(what, fmt::format("{} points", length),
                     fmt::format("at most {} points, because the file then ends", numbers.most(*corners.type)));
      for (std::size_t k = 0; k < length; ++k)
        soup.corners.push_back(static_cast<std::int64_t>(numbers.next(*corners.type, what)));
    }
    soup.end_facet();
    if (numbers.line() > 0) soup.line.push_back(numbers.line());
  }
}

}  // namespace

SurfaceSoup read_ply(const SurfaceFile& file) {
  const PlyHeader header = read_ply_header(file);
  PlyNumbers numbers(file, header);
  SurfaceSoup soup;
  bool points = false, facets = false;
  const auto once = [&](const PlyElement& element, bool& done) {
    if (done) file.fail(element.line, "element " + element.name, "a second element of this name", "only one");
    done = true;
  };
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex" || element.name == "vertices") {
      once(element, points);
      read_points(file, element, numbers, soup);
    } else if (element.name == "face" || element.name == "faces") {
      once(element, facets);
      read_facets(file, element, numbers, soup);
    } else if (!element.properties.empty()) {
      // Skips the items. An element without properties takes no bytes, whatever its number of items.
      for (std::size_t i = 0; i < element.items; ++i) {
        for (const PlyProperty& property : element.properties) numbers.pass(property, "element " + element.name);
      }
    }
  }
  numbers.require_end();
  return soup;
}

}  // namespace macadam
