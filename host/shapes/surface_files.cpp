// SPDX-License-Identifier: GPL-3.0-or-later
// surface_files.cpp  STL, OFF, PLY and OBJ by CGAL's readers and writers, which believe what a file says of itself:
// what they would swallow, or allocate, without a word is looked at before and after.
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "host/results/files.hpp"
#include "host/shapes/equal_points.hpp"
#include "host/shapes/shipped_shapes.hpp"
#include "host/shapes/surface_files.hpp"
#include "host/shapes/surface_numbers.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

/// A facet as files have it; one of more corners than any real one is damage that would fill the memory.
class FilePolygon : public std::vector<std::size_t> {
 public:
  void resize(std::size_t corners) {
    if (corners > 1'000) throw std::length_error(fmt::format("a facet of {} points", corners));
    std::vector<std::size_t>::resize(corners);
  }
};

struct Soup {
  std::vector<Point> points;
  std::vector<FilePolygon> polygons;
};

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

/// Reads one file; every message needs its name.
class SurfaceReader {
 public:
  SurfaceReader(const std::filesystem::path& file, std::string bytes)
      : name_(file.string()), format_(format_of(file)), bytes_(std::move(bytes)) {
    if (bytes_.empty()) fail("surface", "an empty file", "a triangulated surface");
  }

  Surface read(double scale) {
    const Soup soup = read_soup();
    Surface surface{name_, {}, {}};
    for (const Point& p : soup.points) surface.points.push_back(scale * Vec3d{p.x(), p.y(), p.z()});
    for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
      const FilePolygon& polygon = soup.polygons[f];
      const std::string which = fmt::format("facet {}", f);
      if (polygon.size() != 3) fail(which, fmt::format("{} points", polygon.size()), "3");
      for (const std::size_t p : polygon) {
        if (p >= soup.points.size()) {
          fail(which, fmt::format("point {}", p), fmt::format("a number below {}", soup.points.size()));
        }
      }
      surface.facets.push_back({static_cast<std::int32_t>(polygon[0]), static_cast<std::int32_t>(polygon[1]),
                                static_cast<std::int32_t>(polygon[2])});
    }
    require_sound_numbers(surface);
    join_equal_points(surface);
    surface.name = std::filesystem::path(name_).stem().string();
    return surface;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& found, const std::string& expected) const {
    throw InputError(name_, 0, what, found, expected);
  }

  Soup read_soup() {
    Soup soup;
    bool read = false;
    std::string reason;
    try {
      switch (format_) {
        case Format::stl:
          read = read_stl(soup);
          break;
        case Format::off:
          read = read_off(soup);
          break;
        case Format::ply:
          read = read_ply(soup);
          break;
        case Format::obj:
          read = read_obj(soup);
          break;
      }
    } catch (const Error&) { throw; } catch (const std::exception& error) {
      reason = fmt::format(" ({})", error.what());
    }
    if (!read)
      fail("surface", "text or bytes that end too early or make no sense" + reason,
           fmt::format("a whole {} file", endings[static_cast<std::size_t>(format_)]));
    if (soup.polygons.empty()) fail("surface", "no facet", "a triangulated surface");
    return soup;
  }

  static auto quiet() { return CGAL::parameters::verbose(false); }

  template <class Read>
  bool with_stream(Read&& read) {
    std::istringstream in(bytes_, std::ios::binary);
    return read(in);
  }

  bool read_stl(Soup& soup) {
    constexpr std::size_t header = 84, record = 50, corners = 12;  // bytes; a record begins with its normal
    std::uint32_t facets = 0;
    if (bytes_.size() >= header) std::memcpy(&facets, &bytes_[header - 4], 4);
    if (bytes_.size() == header + record * facets) {
      for (std::size_t f = 0; f < facets; ++f) {
        std::array<float, 9> x;
        std::memcpy(x.data(), &bytes_[header + record * f + corners], sizeof x);
        for (const float c : x) {  // the reader joins points as it goes, and one of NaN equals all others
          if (!std::isfinite(c)) fail(fmt::format("facet {}", f), fmt::format("coordinate {}", c), "a finite one");
        }
      }
      bytes_[0] = 'b';  // some programs begin a binary file's free text with "solid", the sign of an ASCII file
    } else if (bytes_.find("endsolid") == std::string::npos) {
      fail("surface", "neither the bytes that a binary file's count asks for nor `endsolid`", "a whole STL file");
    }
    return with_stream([&](auto& in) { return CGAL::IO::read_STL(in, soup.points, soup.polygons, quiet()); });
  }

  bool read_off(Soup& soup) {
    const std::size_t room = bytes_.size();
    with_stream([&](auto& in) {  // the reader allocates what the header says
      const CGAL::File_scanner_OFF header(in);
      if (in && (header.size_of_vertices() > room || header.size_of_facets() > room)) {
        fail("surface", fmt::format("{} points and {} facets", header.size_of_vertices(), header.size_of_facets()),
             fmt::format("no more than {} bytes can hold", room));
      }
      return true;
    });
    return with_stream([&](auto& in) { return CGAL::IO::read_OFF(in, soup.points, soup.polygons, quiet()); });
  }

  bool read_ply(Soup& soup) {
    std::istringstream header(bytes_);
    for (std::string line, word; word != "element" && word != "end_header" && std::getline(header, line);) {
      std::istringstream(line) >> word;  // the reader gives a property to the last element, and there is none yet
      if (word == "property") fail("header", "a property before any element", "a whole .ply file");
    }
    return with_stream([&](auto& in) { return CGAL::IO::read_PLY(in, soup.points, soup.polygons, quiet()); });
  }

  bool read_obj(Soup& soup) {
    return with_stream([&](auto& in) { return CGAL::IO::read_OBJ(in, soup.points, soup.polygons, quiet()); });
  }

  std::string name_;
  Format format_;
  std::string bytes_;
};

std::string bytes_of(const std::filesystem::path& file) {
  const auto fail = [&](const char* found, const char* expected) {
    throw InputError(file.string(), 0, "surface", found, expected);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) fail("a directory", "a file");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  if (!in || !(in.peek() == EOF || all << in.rdbuf())) fail(std::strerror(errno), "a readable file");
  return std::move(all).str();
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
    throw InputError(file.string(), 0, "scale", fmt::format("{}", scale), "a positive finite number");
  }
}

}  // namespace

bool is_surface_file(const std::filesystem::path& file) { return find_format(file).has_value(); }

Surface read_surface(const std::filesystem::path& file, double scale) {
  require_scale(file, scale);
  format_of(file);  // before reading: another ending is the first thing to say
  return SurfaceReader(file, bytes_of(file)).read(scale);
}

void write_surface(const std::filesystem::path& file, const Surface& surface, double scale) {
  require_scale(file, scale);
  require_sound_numbers(surface);
  const Format format = format_of(file);
  std::vector<Point> points;
  for (const Vec3d& p : surface.points) points.emplace_back(p.x / scale, p.y / scale, p.z / scale);
  std::ostringstream out(std::ios::binary);
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
  write_whole(file, out.str());
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
    out.push_back(SurfaceReader(std::string(shape.name) + ".off", std::string(shape.off)).read(1));
  }
  return out;
}

}  // namespace macadam
