// SPDX-License-Identifier: GPL-3.0-or-later
// surface_files.cpp  STL, OFF, PLY and OBJ: which it is, what a surface needs in any of them, and writing by CGAL.
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <optional>
#include <sstream>

#include "host/results/files.hpp"
#include "host/shapes/equal_points.hpp"
#include "host/shapes/shipped_shapes.hpp"
#include "host/shapes/surface_files.hpp"
#include "host/shapes/surface_numbers.hpp"
#include "host/shapes/surface_readers.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

enum class Format : std::uint8_t { stl, off, ply, obj };
constexpr std::array<const char*, 4> endings{".stl", ".off", ".ply", ".obj"};

std::optional<Format> find_format(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = std::find(endings.begin(), endings.end(), ending);
  if (found == endings.end()) return std::nullopt;
  return static_cast<Format>(found - endings.begin());
}

Format format_of(const std::filesystem::path& file) {
  if (const auto format = find_format(file)) return *format;
  throw InputError(file.string(), 0, "ending", file.has_extension() ? file.extension().string() : "none",
                   fmt::format("one of {}", fmt::join(endings, " ")));
}

SurfaceSoup read_soup(const SurfaceFile& file, Format format) {
  switch (format) {
    case Format::stl:
      return read_stl(file);
    case Format::off:
      return read_off(file);
    case Format::ply:
      return read_ply(file);
    case Format::obj:
      break;
  }
  return read_obj(file);
}

/// The surface in a file's bytes; its name is the file's, as messages show it.
Surface surface_in(const SurfaceFile& file, Format format, double scale) {
  if (file.bytes.empty()) file.fail(0, "surface", "an empty file", "a triangulated surface");
  const SurfaceSoup soup = read_soup(file, format);
  if (soup.facets.empty()) file.fail(0, "surface", "no facet", "a triangulated surface");
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (soup.points.size() > most || soup.facets.size() > most)
    file.fail(0, "surface", fmt::format("{} points and {} facets", soup.points.size(), soup.facets.size()),
              fmt::format("at most {}", most));
  Surface surface{file.name, {}, {}};
  for (const Vec3d& p : soup.points) surface.points.push_back(scale * p);
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    auto& facet = surface.facets.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const std::int64_t p = soup.facets[f][k];
      if (p < 0 || p >= std::ssize(soup.points)) {
        file.fail(soup.line.empty() ? 0 : soup.line[f], fmt::format("facet {}", f), fmt::format("point {}", p),
                  fmt::format("a number below {}", soup.points.size()));
      }
      facet[k] = static_cast<std::int32_t>(p);
    }
  }
  require_sound_numbers(surface);
  join_equal_points(surface);
  return surface;
}

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
  std::string bytes(static_cast<std::size_t>(in.tellg()), '\0');  // streams would take want of memory for a bad file
  if (!in.seekg(0).read(bytes.data(), std::ssize(bytes))) fail(std::strerror(errno), "a readable file");
  return bytes;
}

/// The fewest digits, up to the 17 that always do, with which every coordinate comes back to the bit.
int digits_for(const std::vector<Point>& points) {
  int digits = 6;
  for (const Point& p : points) {
    for (const double x : {p.x(), p.y(), p.z()}) {
      while (digits < 17 && std::strtod(fmt::format("{:.{}g}", x, digits).c_str(), nullptr) != x) ++digits;
    }
  }
  return digits;
}

void require_scale(const std::filesystem::path& file, double scale) {
  if (!(scale > 0 && std::isfinite(scale))) {
    throw InputError(file.string(), 0, "scale (--scale), metres per unit of the file", fmt::format("{}", scale),
                     "a positive finite number");
  }
}

void require_floats(const std::filesystem::path& file, const std::vector<Point>& points) {
  for (const Point& p : points) {
    for (const double x : {p.x(), p.y(), p.z()}) {
      if (!std::isfinite(static_cast<float>(x)))
        throw InputError(file.string(), 0, "coordinate", fmt::format("{}", x), "one that single precision can hold");
    }
  }
}

/// What the file will hold.
std::string bytes_for(const std::filesystem::path& file, const Surface& surface, double scale) {
  require_scale(file, scale);
  require_sound_numbers(surface);
  const Format format = format_of(file);
  std::vector<Point> points;
  for (const Vec3d& p : surface.points) points.emplace_back(p.x / scale, p.y / scale, p.z / scale);
  if (format == Format::stl) require_floats(file, points);
  std::ostringstream out(std::ios::binary);
  out.exceptions(std::ios::badbit);  // want of memory stays what it is
  const auto text = CGAL::parameters::stream_precision(digits_for(points));
  bool written = false;
  switch (format) {
    case Format::stl:
      CGAL::IO::set_mode(out, CGAL::IO::BINARY);
      written = CGAL::IO::write_STL(out, points, surface.facets);
      break;
    case Format::ply:
      CGAL::IO::set_mode(out, CGAL::IO::BINARY);
      written = CGAL::IO::write_PLY(out, points, surface.facets);
      break;
    case Format::off:
      written = CGAL::IO::write_OFF(out, points, surface.facets, text);
      break;
    case Format::obj:
      written = CGAL::IO::write_OBJ(out, points, surface.facets, text);
      break;
  }
  if (!written) throw RunError(file.string() + ": the surface cannot be written");
  return std::move(out).str();
}

}  // namespace

bool is_surface_file(const std::filesystem::path& file) { return find_format(file).has_value(); }

Surface read_surface(const std::filesystem::path& file, double scale) {
  require_scale(file, scale);
  const Format format = format_of(file);  // before reading: another ending is the first thing to say
  const std::string bytes = bytes_of(file);
  Surface surface = surface_in({file.string(), bytes}, format, scale);
  surface.name = file.stem().string();
  return surface;
}

void write_surface(const std::filesystem::path& file, const Surface& surface, double scale) {
  write_whole(file, bytes_for(file, surface, scale));
}

Surface read_back(const std::filesystem::path& file, const Surface& surface) {
  const std::string bytes = bytes_for(file, surface, 1);
  return surface_in({file.string(), bytes}, format_of(file), 1);
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

std::vector<Surface> read_shape_library(const std::filesystem::path& folder) {
  std::vector<Surface> out;
  for (const std::filesystem::path& file : surface_files_in(folder)) {
    out.push_back(read_surface(file));
    const SurfaceVerdict verdict = check_surface(out.back());
    if (!verdict.good()) throw InputError(file.string(), 0, "surface", verdict.text(), "a closed surface");
  }
  return out;
}

std::vector<Surface> shape_library() {
  std::vector<Surface> out;
  for (const ShippedShape& shape : shipped_shapes()) {
    out.push_back(surface_in({std::string(shape.name) + ".off", shape.off}, Format::off, 1));
    out.back().name = shape.name;
  }
  return out;
}

}  // namespace macadam
