// SPDX-License-Identifier: GPL-3.0-or-later
// read_surface.cpp  Reads surfaces: chooses the format (STL, OFF, PLY or OBJ) and applies the checks and changes common
// to all formats.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <optional>

#include "host/shapes/files/cut_polygon.hpp"
#include "host/shapes/files/equal_points.hpp"
#include "host/shapes/files/join_seams.hpp"
#include "host/shapes/files/surface_files.hpp"
#include "host/shapes/files/surface_numbers.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr std::array<const char*, 4> endings{".stl", ".off", ".ply", ".obj"};

std::optional<SurfaceFormat> find_format(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = std::find(endings.begin(), endings.end(), ending);
  if (found == endings.end()) return std::nullopt;
  return static_cast<SurfaceFormat>(found - endings.begin());
}

SurfaceSoup read_soup(const SurfaceFile& file, SurfaceFormat format) {
  switch (format) {
    case SurfaceFormat::stl:
      return read_stl(file);
    case SurfaceFormat::off:
      return read_off(file);
    case SurfaceFormat::ply:
      return read_ply(file);
    case SurfaceFormat::obj:
      break;
  }
  return read_obj(file);
}

/// Returns for example "1 polygon" or "3 polygons".
std::string counted(std::int64_t n, const char* of) { return fmt::format("{} {}{}", n, of, n == 1 ? "" : "s"); }

void add_note(Surface& surface, const std::string& note) {
  if (!note.empty()) surface.reading += (surface.reading.empty() ? "" : "; ") + note;
}

/// Checks that every corner is the number of a point. \throws InputError if it is not.
void require_points(const SurfaceFile& file, const SurfaceSoup& soup) {
  const std::int64_t points = std::ssize(soup.points), first = soup.first_number;
  for (std::size_t f = 0; f < soup.facets(); ++f) {
    for (const std::int64_t p : soup.facet(f)) {
      if (p >= 0 && p < points) continue;
      file.fail(soup.line.empty() ? 0 : soup.line[f], facet_name(f), fmt::format("point {}", p + first),
                first == 0 ? fmt::format("a number below {}", points)
                           : fmt::format("a number from {} to {}", first, points - 1 + first));
    }
  }
}

/// Appends the facets as triangles, in the order of the file.
void add_facets(Surface& surface, const SurfaceSoup& soup) {
  // A polygon counts as bent if the distance of a corner from the polygon's mean plane exceeds this fraction of the
  // polygon's radius. How a bent polygon is divided makes a visible difference.
  constexpr double bent = 0.01;
  std::int64_t polygons = 0, bent_ones = 0, crossed = 0;
  double bend = 0;
  for (std::size_t f = 0; f < soup.facets(); ++f) {
    const std::span<const std::int64_t> c = soup.facet(f);
    if (c.size() == 3) {
      const auto number = [&](int k) { return static_cast<std::int32_t>(c[k]); };
      surface.facets.push_back({number(0), number(1), number(2)});
      continue;
    }
    const PolygonCut cut = cut_polygon(surface.points, c, surface.facets);
    ++polygons;
    bent_ones += cut.bend > bent;
    bend = std::max(bend, cut.bend);
    crossed += cut.crossed;
  }
  if (polygons == 0) return;
  std::string note = fmt::format("cut {} into triangles", counted(polygons, "polygon"));
  if (bent_ones > 0)
    note += fmt::format(", {} of them not flat (corners up to {:.2g} % of the radius from the plane)", bent_ones,
                        100 * bend);
  if (crossed > 0) note += fmt::format(", {} of them with an outline that crosses or touches itself", crossed);
  add_note(surface, note);
}

/// Returns the content of a file.
std::string bytes_of(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& found, const char* expected) {
    throw InputError(file.string(), 0, "surface", found, expected);
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) fail("a directory", "a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) fail("a device or pipe", "a file");
  errno = 0;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in && errno == ENOMEM) throw std::bad_alloc();
  if (!in) fail(std::strerror(errno), "a readable file");
  // The memory is allocated here, so that too little memory throws std::bad_alloc. A stream would report too little
  // memory as a bad file.
  std::string bytes(static_cast<std::size_t>(in.tellg()), '\0');
  if (!in.seekg(0).read(bytes.data(), std::ssize(bytes))) fail(std::strerror(errno), "a readable file");
  return bytes;
}

}  // namespace

SurfaceFormat format_of(const std::filesystem::path& file) {
  if (const auto format = find_format(file)) return *format;
  throw InputError(file.string(), 0, "ending", file.has_extension() ? file.extension().string() : "none",
                   fmt::format("one of {}", fmt::join(endings, " ")));
}

Surface surface_in(const SurfaceFile& file, SurfaceFormat format, double scale) {
  if (file.bytes.empty()) file.fail(0, "surface", "an empty file", "a triangulated surface");
  const SurfaceSoup soup = read_soup(file, format);
  if (soup.facets() == 0) file.fail(0, "surface", "no facet", "a triangulated surface");
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (soup.points.size() > most || soup.triangles() > most)
    file.fail(0, "surface", fmt::format("{} points and {} triangles", soup.points.size(), soup.triangles()),
              fmt::format("at most {0} points and {0} triangles", most));
  require_points(file, soup);
  Surface surface{file.name, {}, {}};
  for (const Vec3d& p : soup.points) surface.points.push_back(scale * p);
  require_sound_points(surface);
  add_note(surface, soup.note);
  add_facets(surface, soup);
  join_equal_points(surface);
  const double width = seam_width(surface);
  const SeamJoin seams = join_seams(surface);
  if (surface.facets.empty())
    file.fail(0, "surface", "no facet that single precision resolves", "a triangulated surface");
  if (seams.points > 0)
    add_note(
        surface,
        fmt::format("merged {} on open edges, each with another one less than {:.2g} m away{}",
                    counted(seams.points, "point"), width,
                    seams.facets > 0 ? fmt::format("; {} then have no area", counted(seams.facets, "facet")) : ""));
  return surface;
}

void require_scale(const std::filesystem::path& file, double scale) {
  if (!(scale > 0 && std::isfinite(scale))) {
    throw InputError(file.string(), 0, "scale (--scale), metres per unit of the file", fmt::format("{}", scale),
                     "a positive finite number");
  }
}

bool is_surface_file(const std::filesystem::path& file) { return find_format(file).has_value(); }

Surface read_surface(const std::filesystem::path& file, double scale) {
  require_scale(file, scale);
  const SurfaceFormat format = format_of(file);  // before reading, so that a wrong ending is reported first
  const std::string bytes = bytes_of(file);
  Surface surface = surface_in({file.string(), bytes}, format, scale);
  surface.name = file.stem().string();
  return surface;
}

std::vector<std::filesystem::path> surface_files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_surface_file(entry.path())) files.push_back(entry.path());
  }
  if (files.empty())
    throw InputError(folder.string(), 0, "folder", "no surface in it",
                     fmt::format("files that end in {}", fmt::join(endings, " ")));
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace macadam
