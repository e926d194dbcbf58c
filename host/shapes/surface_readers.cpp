// SPDX-License-Identifier: GPL-3.0-or-later
// surface_readers.cpp  STL, OFF and OBJ.
#include "host/shapes/surface_readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "host/in_quotes.hpp"
#include "host/shapes/surface_words.hpp"

namespace macadam {
namespace {

std::string point_name(std::size_t p) { return fmt::format("point {}", p); }
std::string facet_name(std::size_t f) { return fmt::format("facet {}", f); }

/// Three numbers from wherever `word` takes them.
template <class Word>
Vec3d coordinates(const Words& words, const std::string& what, Word&& word) {
  const double x = words.number(word(), what), y = words.number(word(), what), z = words.number(word(), what);
  return {x, y, z};
}

/// A point's line from here on; colours and the like that follow the coordinates must be numbers too.
Vec3d point_line(Words& words, std::size_t number) {
  const std::string what = point_name(number);
  const Vec3d point = coordinates(words, what, [&] { return words.in_line(); });
  for (auto more = words.in_line(); !more.empty(); more = words.in_line()) words.number(more, what);
  return point;
}

SurfaceSoup read_binary_stl(const SurfaceFile& file, std::size_t facets, std::size_t header, std::size_t record) {
  constexpr std::size_t corners = 12;  // bytes of a record before them: its normal
  SurfaceSoup soup;
  for (std::size_t f = 0; f < facets; ++f) {
    std::array<float, 9> x;
    std::memcpy(x.data(), &file.bytes[header + record * f + corners], sizeof x);
    for (const float c : x) {
      if (!std::isfinite(c)) file.fail(0, facet_name(f), fmt::format("coordinate {}", c), "a finite one");
    }
    const auto p = static_cast<std::int64_t>(soup.points.size());
    for (int k = 0; k < 3; ++k) soup.points.push_back({x[3 * k], x[3 * k + 1], x[3 * k + 2]});
    soup.facets.push_back({p, p + 1, p + 2});
  }
  return soup;
}

/// `facet normal 0 0 1 outer loop vertex x y z vertex … endloop endfacet`: what stands between the words that count is
/// left out, as many programs write nonsense there (normals that are NaN).
SurfaceSoup read_ascii_stl(const SurfaceFile& file) {
  SurfaceSoup soup;
  Words words(file);
  bool in_facet = false, closed = false;
  std::size_t corners = 0;
  const auto out_of_place = [&](std::string_view word) {
    words.fail(facet_name(soup.facets.size()), in_quotes(word),
               in_facet ? "vertex or endfacet" : "facet or endsolid, as a facet is not open");
  };
  while (words.next_line()) {
    for (auto word = words.in_line(); !word.empty(); word = words.in_line()) {
      const bool solid = word == "solid", endsolid = word == "endsolid", facet = word == "facet";
      const bool inner = word == "vertex" || word == "endfacet";
      if (inner != in_facet && (inner || solid || endsolid || facet)) out_of_place(word);
      if (solid || endsolid) {
        closed = endsolid;
        words.skip_line();  // the rest is a name
      } else if (facet) {
        in_facet = true, corners = 0;
      } else if (word == "vertex") {
        soup.points.push_back(
            coordinates(words, facet_name(soup.facets.size()), [&] { return words.next("a number"); }));
        ++corners;
      } else if (word == "endfacet") {
        if (corners != 3) words.fail(facet_name(soup.facets.size()), fmt::format("{} points", corners), "3");
        const auto p = static_cast<std::int64_t>(soup.points.size());
        soup.facets.push_back({p - 3, p - 2, p - 1});
        soup.line.push_back(words.line());
        in_facet = false;
      } else if (!in_facet) {
        out_of_place(word);
      }
    }
  }
  if (in_facet || !closed) words.fail("surface", "the end of the file", in_facet ? "endfacet" : "endsolid");
  return soup;
}

}  // namespace

SurfaceSoup read_stl(const SurfaceFile& file) {
  constexpr std::size_t header = 84, record = 50;  // bytes
  std::uint32_t facets = 0;
  if (file.bytes.size() >= header) std::memcpy(&facets, &file.bytes[header - 4], 4);
  // Some programs begin a binary file's free text with "solid", the sign of an ASCII file: the size tells.
  if (file.bytes.size() == header + record * facets) return read_binary_stl(file, facets, header, record);
  if (file.bytes.find("endsolid") == std::string::npos)
    file.fail(0, "surface", "neither the bytes that a binary file's count asks for nor `endsolid`", "a whole STL file");
  return read_ascii_stl(file);
}

SurfaceSoup read_off(const SurfaceFile& file) {
  Words words(file, '#');
  const std::string_view keyword = words.next("OFF");
  std::string_view plain = keyword;
  for (const std::string_view extra : {"ST", "C", "N"})  // texture, colours, normals: behind the coordinates
    if (plain.starts_with(extra)) plain.remove_prefix(extra.size());
  if (plain != "OFF") words.fail("header", in_quotes(keyword), "OFF, a text file of points with three coordinates");
  const std::size_t points = words.count(words.next("the number of points"), "number of points");
  const std::size_t facets = words.count(words.next("the number of facets"), "number of facets");
  constexpr std::size_t least = 5;  // bytes of a line: "0 0 0"
  if (points > file.bytes.size() / least || facets > file.bytes.size() / least)
    words.fail("surface", fmt::format("{} points and {} facets", points, facets),
               fmt::format("no more than {} bytes can hold", file.bytes.size()));

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
    if (corners != 3) words.fail(what, fmt::format("{} points", corners), "3");
    auto& facet = soup.facets.emplace_back();
    for (std::int64_t& p : facet) p = words.integer(words.in_line(), what);
    for (auto colour = words.in_line(); !colour.empty(); colour = words.in_line()) words.number(colour, what);
    soup.line.push_back(words.line());
  }
  if (words.next_line())
    words.fail("surface", in_quotes(words.in_line()), fmt::format("the end of the file after {} facets", facets));
  return soup;
}

SurfaceSoup read_obj(const SurfaceFile& file) {
  constexpr std::string_view without_facets[] = {
      // of colours, normals, groups, curves, …
      "vt",   "vn",     "vp",     "l",      "p",          "o",         "g",     "s",     "bevel",
      "lod",  "mtllib", "usemtl", "usemap", "c_interp",   "d_interp",  "ctech", "stech", "step",
      "deg",  "cstype", "bmat",   "curv",   "curv2",      "surf",      "parm",  "trim",  "hole",
      "scrv", "sp",     "con",    "end",    "shadow_obj", "trace_obj", "call",  "csh",   "mg"};
  SurfaceSoup soup;
  Words words(file, '#');
  while (words.next_line()) {
    const std::string_view keyword = words.in_line();
    if (keyword == "v") {
      soup.points.push_back(point_line(words, soup.points.size()));
    } else if (keyword == "f") {
      const std::string what = facet_name(soup.facets.size());
      std::array<std::int64_t, 3> facet{};
      std::size_t corners = 0;
      for (auto word = words.in_line(); !word.empty(); word = words.in_line()) {  // point/texture/normal
        const std::int64_t p = words.integer(word.substr(0, word.find('/')), what);
        // From 1; negative ones count back from the last point so far.
        if (corners < facet.size()) facet[corners] = p < 0 ? p + static_cast<std::int64_t>(soup.points.size()) : p - 1;
        ++corners;
      }
      if (corners != facet.size()) words.fail(what, fmt::format("{} points", corners), "3");
      soup.facets.push_back(facet);
      soup.line.push_back(words.line());
    } else if (std::find(std::begin(without_facets), std::end(without_facets), keyword) == std::end(without_facets)) {
      words.fail("keyword", in_quotes(keyword), "v, f or another one of OBJ");
    }
  }
  return soup;
}

}  // namespace macadam
