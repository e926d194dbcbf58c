// SPDX-License-Identifier: GPL-3.0-or-later
// read_stl.cpp  Reads STL files, binary and ASCII.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>

#include "host/base/in_quotes.hpp"
#include "host/shapes/files/surface_readers.hpp"
#include "host/shapes/files/surface_words.hpp"

namespace macadam {
namespace {

constexpr std::size_t header_bytes = 84, record_bytes = 50;

/// Appends a facet whose corners are the last three points.
void add_triangle(SurfaceSoup& soup) {
  const auto p = static_cast<std::int64_t>(soup.points.size());
  soup.corners.insert(soup.corners.end(), {p - 3, p - 2, p - 1});
  soup.end_facet();
}

SurfaceSoup read_binary(const SurfaceFile& file, std::size_t facets) {
  constexpr std::size_t normal_bytes = 12;  // each record begins with a normal, which is skipped
  SurfaceSoup soup;
  for (std::size_t f = 0; f < facets; ++f) {
    std::array<float, 9> x;
    std::memcpy(x.data(), &file.bytes[header_bytes + record_bytes * f + normal_bytes], sizeof x);
    for (const float c : x) {
      if (!std::isfinite(c)) file.fail(0, facet_name(f), fmt::format("coordinate {}", c), "a finite coordinate");
    }
    for (int k = 0; k < 3; ++k) soup.points.push_back({x[3 * k], x[3 * k + 1], x[3 * k + 2]});
    add_triangle(soup);
  }
  if (const std::size_t left = file.bytes.size() - header_bytes - record_bytes * facets; left > 0)
    soup.note = fmt::format("left out {} byte{} after the last facet", left, left == 1 ? "" : "s");
  return soup;
}

/// Returns whether a word equals `keyword`, regardless of case. `keyword` is given in lower case.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

enum class Keyword : std::uint8_t { none, solid, endsolid, facet, vertex, endfacet };

/// Returns the keyword for a word. For `end solid` and `end facet`, which some files write as two words, also reads the
/// second word.
Keyword keyword_of(std::string_view word, Words& words) {
  if (is_keyword(word, "vertex")) return Keyword::vertex;
  if (is_keyword(word, "facet")) return Keyword::facet;
  if (is_keyword(word, "endfacet")) return Keyword::endfacet;
  if (is_keyword(word, "solid")) return Keyword::solid;
  if (is_keyword(word, "endsolid")) return Keyword::endsolid;
  if (!is_keyword(word, "end")) return Keyword::none;
  const std::string_view second = words.in_line();
  if (is_keyword(second, "facet")) return Keyword::endfacet;
  return is_keyword(second, "solid") ? Keyword::endsolid : Keyword::none;
}

/// Reads the ASCII form `facet normal 0 0 1 outer loop vertex x y z vertex … endloop endfacet`. Other words between
/// these keywords are skipped, because some programs write normals that are not numbers.
class AsciiStl {
 public:
  explicit AsciiStl(const SurfaceFile& file) : words_(file) {}

  SurfaceSoup read() {
    while (words_.next_line()) {
      for (auto word = words_.in_line(); !word.empty(); word = words_.in_line()) take(word);
    }
    if (in_facet_ || !closed_) words_.fail("surface", "the end of the file", in_facet_ ? "endfacet" : "endsolid");
    return std::move(soup_);
  }

 private:
  /// Processes one word.
  void take(std::string_view word) {
    const Keyword keyword = keyword_of(word, words_);
    const bool inner = keyword == Keyword::vertex || keyword == Keyword::endfacet;
    if (keyword == Keyword::none ? !in_facet_ : inner != in_facet_)
      words_.fail(facet_name(soup_.facets()), in_quotes(word),
                  in_facet_ ? "vertex or endfacet" : "facet or endsolid, because no facet is open");
    switch (keyword) {
      case Keyword::solid:
      case Keyword::endsolid:
        closed_ = keyword == Keyword::endsolid;
        words_.skip_line();  // the rest of the line is a name
        break;
      case Keyword::facet:
        in_facet_ = true, corners_ = 0;
        break;
      case Keyword::vertex:
        take_point();
        break;
      case Keyword::endfacet:
        if (corners_ != 3) words_.fail(facet_name(soup_.facets()), fmt::format("{} points", corners_), "3");
        add_triangle(soup_);
        soup_.line.push_back(words_.line());
        in_facet_ = false;
        break;
      case Keyword::none:
        break;
    }
  }

  void take_point() {
    const std::string what = facet_name(soup_.facets());
    const auto number = [&] { return words_.number(words_.next("a number"), what); };
    const double x = number(), y = number(), z = number();
    soup_.points.push_back({x, y, z});
    ++corners_;
  }

  Words words_;
  SurfaceSoup soup_;
  bool in_facet_ = false, closed_ = false;
  std::size_t corners_ = 0;
};

/// Returns whether the file begins with a word with which ASCII files begin.
bool begins_as_ascii(const SurfaceFile& file) {
  Words words(file);
  if (!words.next_line()) return false;
  const Keyword first = keyword_of(words.in_line(), words);
  return first == Keyword::solid || first == Keyword::facet;
}

}  // namespace

SurfaceSoup read_stl(const SurfaceFile& file) {
  std::uint32_t facets = 0;
  const std::size_t size = file.bytes.size();
  if (size >= header_bytes) std::memcpy(&facets, &file.bytes[header_bytes - 4], 4);
  // The header of a binary file may begin with "solid" like an ASCII file, so the file size decides. In an ASCII file
  // the four bytes at the position of the number of facets are characters. Read as a number, they give 150 million
  // facets or more, so the file size does not match.
  const std::size_t expected = header_bytes + record_bytes * facets;
  if (size >= expected && size - expected < record_bytes) return read_binary(file, facets);
  const bool has_zero = file.bytes.substr(0, header_bytes).find('\0') != std::string_view::npos;
  if (!has_zero && begins_as_ascii(file)) return AsciiStl(file).read();
  const std::string ascii = "an ASCII file that begins with `solid`";
  if (size < header_bytes)
    file.fail(0, "surface", fmt::format("{} bytes", size), "84 bytes or more (a binary file), or " + ascii);
  file.fail(0, "surface", fmt::format("{} bytes", size),
            fmt::format("{} bytes, because the header of a binary file counts {} facet{}, or {}", expected, facets,
                        facets == 1 ? "" : "s", ascii));
}

}  // namespace macadam
