// SPDX-License-Identifier: GPL-3.0-or-later
// surface_readers.cpp  Reads OFF and OBJ files.
#include "host/shapes/files/surface_readers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/base/in_quotes.hpp"
#include "host/shapes/files/surface_words.hpp"

namespace macadam {
namespace {

std::string point_name(std::size_t p) { return fmt::format("point {}", p); }

/// Reads three numbers from the words that word() returns.
template <class Word>
Vec3d coordinates(const Words& words, const std::string& what, Word&& word) {
  const double x = words.number(word(), what), y = words.number(word(), what), z = words.number(word(), what);
  return {x, y, z};
}

/// Reads the coordinates of a point from the rest of a line. Colours and other values after the coordinates must be
/// numbers too.
Vec3d point_line(Words& words, std::size_t number) {
  const std::string what = point_name(number);
  const Vec3d point = coordinates(words, what, [&] { return words.in_line(); });
  for (auto more = words.in_line(); !more.empty(); more = words.in_line()) words.number(more, what);
  return point;
}

/// Reads the rest of an `f` line, whose words have the form point/texture/normal.
void obj_facet(Words& words, SurfaceSoup& soup) {
  const std::string what = facet_name(soup.facets());
  const auto points = static_cast<std::int64_t>(soup.points.size());
  const std::size_t begin = soup.corners.size();
  for (auto word = words.in_line(); !word.empty(); word = words.in_line()) {
    const std::int64_t p = words.integer(word.substr(0, word.find('/')), what);
    // Points are numbered from 1; negative numbers count backwards from the last point so far.
    if (p == 0 || p < -points)
      words.fail(what, fmt::format("point {}", p), fmt::format("a number from 1, or from -{} to -1", points));
    soup.corners.push_back(p < 0 ? p + points : p - 1);
  }
  const std::size_t corners = soup.corners.size() - begin;
  if (corners < 3) words.fail(what, fmt::format("{} points", corners), "3 or more");
  soup.end_facet();
}

}  // namespace

SurfaceSoup read_off(const SurfaceFile& file) {
  Words words(file, '#');
  const std::string_view keyword = words.next("OFF");
  std::string_view plain = keyword;
  // Removes the prefixes for texture coordinates, colours and normals. These values follow the coordinates in a line.
  for (const std::string_view extra : {"ST", "C", "N"})
    if (plain.starts_with(extra)) plain.remove_prefix(extra.size());
  if (plain != "OFF")
    words.fail("header", in_quotes(keyword),
               "the word OFF, with which a text file of points with three coordinates begins");
  const std::size_t points = words.count(words.next("the number of points"), "number of points");
  const std::size_t facets = words.count(words.next("the number of facets"), "number of facets");
  constexpr std::size_t least = 5;  // bytes of the shortest line: "0 0 0"
  if (points > file.bytes.size() / least || facets > file.bytes.size() / least)
    words.fail("surface", fmt::format("{} points and {} facets", points, facets),
               fmt::format("fewer, because the file has only {} bytes", file.bytes.size()));

  SurfaceSoup soup;
  const auto go_to = [&](const std::string& what, std::size_t of) {
    if (!words.next_line()) words.fail("surface", "the end of the file", fmt::format("{} of {}", what, of));
  };
  for (std::size_t p = 0; p < points; ++p) {
    go_to(point_name(p), points);
    soup.points.push_back(point_line(words, p));
  }
  for (std::size_t f = 0; f < facets; ++f) {
    const std::string what = facet_name(f);
    go_to(what, facets);
    const std::int64_t corners = words.integer(words.in_line(), what);
    const auto in_line = static_cast<std::int64_t>(words.left_in_line() / 2);  // each number takes a blank and a digit
    if (corners < 3 || corners > in_line)
      words.fail(what, fmt::format("{} points", corners),
                 corners < 3 ? "3 or more" : fmt::format("at most {}, because the line then ends", in_line));
    for (std::int64_t k = 0; k < corners; ++k) soup.corners.push_back(words.integer(words.in_line(), what));
    soup.end_facet();
    for (auto colour = words.in_line(); !colour.empty(); colour = words.in_line()) words.number(colour, what);
    soup.line.push_back(words.line());
  }
  if (words.next_line())
    words.fail("surface", in_quotes(words.in_line()), fmt::format("the end of the file after {} facets", facets));
  return soup;
}

SurfaceSoup read_obj(const SurfaceFile& file) {
  constexpr std::string_view without_facets[] = {
      // keywords of colours, normals, groups, curves, …
      "vt",   "vn",     "vp",     "l",      "p",          "o",         "g",     "s",     "bevel",
      "lod",  "mtllib", "usemtl", "usemap", "c_interp",   "d_interp",  "ctech", "stech", "step",
      "deg",  "cstype", "bmat",   "curv",   "curv2",      "surf",      "parm",  "trim",  "hole",
      "scrv", "sp",     "con",    "end",    "shadow_obj", "trace_obj", "call",  "csh",   "mg"};
  SurfaceSoup soup;
  soup.first_number = 1;
  Words words(file, '#');
  words.continue_lines_after('\\');
  while (words.next_line()) {
    const std::string_view keyword = words.in_line();
    if (keyword == "v") {
      soup.points.push_back(point_line(words, soup.points.size()));
    } else if (keyword == "f") {
      obj_facet(words, soup);
      soup.line.push_back(words.line());
    } else if (std::find(std::begin(without_facets), std::end(without_facets), keyword) != std::end(without_facets)) {
      while (!words.in_line().empty()) continue;  // skips the line and its continuation lines
    } else {
      words.fail("keyword", in_quotes(keyword), "v, f or another keyword of OBJ files");
    }
  }
  return soup;
}

}  // namespace macadam
