// SPDX-License-Identifier: GPL-3.0-or-later
// surface_files.cpp  Writes STL, OFF, PLY and OBJ files with CGAL, and reads folders of surfaces (shape libraries).
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "host/files/result_files.hpp"
#include "host/shapes/files/shipped_shapes.hpp"
#include "host/shapes/files/surface_files.hpp"
#include "host/shapes/files/surface_numbers.hpp"
#include "host/shapes/files/surface_readers.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

/// Returns the smallest number of digits with which every coordinate is read back to the same bits; 17 always suffice.
int digits_for(const std::vector<Point>& points) {
  int digits = 6;
  for (const Point& p : points) {
    for (const double x : {p.x(), p.y(), p.z()}) {
      while (digits < 17 && std::strtod(fmt::format("{:.{}g}", x, digits).c_str(), nullptr) != x) ++digits;
    }
  }
  return digits;
}

void require_floats(const std::filesystem::path& file, const std::vector<Point>& points) {
  for (const Point& p : points) {
    for (const double x : {p.x(), p.y(), p.z()}) {
      if (!std::isfinite(static_cast<float>(x)))
        throw InputError(file.string(), 0, "coordinate", fmt::format("{}", x),
                         "a number that single precision can hold");
    }
  }
}

/// Returns the content of the file for this surface.
std::string bytes_for(const std::filesystem::path& file, const Surface& surface, double scale) {
  require_scale(file, scale);
  require_sound_numbers(surface);
  const SurfaceFormat format = format_of(file);
  std::vector<Point> points;
  for (const Vec3d& p : surface.points) points.emplace_back(p.x / scale, p.y / scale, p.z / scale);
  if (format == SurfaceFormat::stl) require_floats(file, points);
  std::ostringstream out(std::ios::binary);
  out.exceptions(std::ios::badbit);  // otherwise the stream catches std::bad_alloc
  const auto text = CGAL::parameters::stream_precision(digits_for(points));
  bool written = false;
  switch (format) {
    case SurfaceFormat::stl:
      CGAL::IO::set_mode(out, CGAL::IO::BINARY);
      written = CGAL::IO::write_STL(out, points, surface.facets);
      break;
    case SurfaceFormat::ply:
      CGAL::IO::set_mode(out, CGAL::IO::BINARY);
      written = CGAL::IO::write_PLY(out, points, surface.facets);
      break;
    case SurfaceFormat::off:
      written = CGAL::IO::write_OFF(out, points, surface.facets, text);
      break;
    case SurfaceFormat::obj:
      written = CGAL::IO::write_OBJ(out, points, surface.facets, text);
      break;
  }
  if (!written) throw RunError(file.string() + ": the surface cannot be written");
  return std::move(out).str();
}

}  // namespace

void write_surface(const std::filesystem::path& file, const Surface& surface, double scale) {
  write_whole(file, bytes_for(file, surface, scale));
}

Surface read_back(const std::filesystem::path& file, const Surface& surface) {
  const std::string bytes = bytes_for(file, surface, 1);
  return surface_in({file.string(), bytes}, format_of(file), 1);
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
    out.push_back(surface_in({std::string(shape.name) + ".off", shape.off}, SurfaceFormat::off, 1));
    out.back().name = shape.name;
  }
  return out;
}

}  // namespace macadam
