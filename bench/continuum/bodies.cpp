// SPDX-License-Identifier: GPL-3.0-or-later
// bodies.cpp  Reads balls, and library shapes with their pose, and intersects them with vertical lines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "bench/continuum/sampling.hpp"
#include "macadam/shape.hpp"

namespace macadam::continuum {
namespace {

/// Rows of a CSV file, read by the names of their columns.
class Table {
 public:
  explicit Table(const std::string& file) : file_(file), in_(file) {
    if (!in_) throw std::runtime_error(file + ": cannot be read");
    next();
    names_ = words_;
  }
  bool next() {
    std::string line;
    if (!std::getline(in_, line)) return false;
    ++number_;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    words_.clear();
    std::istringstream row(line);
    for (std::string word; std::getline(row, word, ',');) words_.push_back(word);
    return true;
  }
  const std::string& text(const std::string& name) const {
    const auto at = std::size_t(std::find(names_.begin(), names_.end(), name) - names_.begin());
    if (at == names_.size()) throw std::runtime_error(fmt::format("{}:1: found no column {}", file_, name));
    if (at >= words_.size()) refuse(fmt::format("{} values, expected {}", words_.size(), names_.size()));
    return words_[at];
  }
  double number(const std::string& name) const {
    const std::string& word = text(name);
    std::size_t read = 0;
    double value = NAN;
    try {
      value = std::stod(word, &read);
    } catch (const std::exception&) {}
    if (read == 0 || read != word.size() || !std::isfinite(value))
      refuse(fmt::format("\"{}\" in column {}, expected a number", word, name));
    return value;
  }
  double positive(const std::string& name) const {
    const double value = number(name);
    if (value <= 0) refuse(fmt::format("{} in column {}, expected a positive number", value, name));
    return value;
  }
  Point point() const { return {number("x"), number("y"), number("z")}; }
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: found {}", file_, number_, what));
  }

 private:
  std::string file_;
  std::ifstream in_;
  int number_ = 0;
  std::vector<std::string> names_, words_;
};

Body ball(const Point& centre, double radius) {
  Body out;
  for (std::size_t i = 0; i < 3; ++i) out.low[i] = centre[i] - radius, out.high[i] = centre[i] + radius;
  out.crossings = [=](double x, double y) -> std::vector<double> {
    const double rest = radius * radius - (x - centre[0]) * (x - centre[0]) - (y - centre[1]) * (y - centre[1]);
    if (rest <= 0) return {};
    return {centre[2] - std::sqrt(rest), centre[2] + std::sqrt(rest)};
  };
  return out;
}

/// A closed surface in its place, with a list of the facets above each cell of a plane grid.
class PlacedSurface {
 public:
  PlacedSurface(std::vector<Point> points, const std::vector<std::array<std::int32_t, 3>>& facets)
      : points_(std::move(points)), facets_(facets), low_(points_[0]), high_(points_[0]) {
    for (const Point& p : points_)
      for (std::size_t i = 0; i < 3; ++i) low_[i] = std::min(low_[i], p[i]), high_[i] = std::max(high_[i], p[i]);
    count_ = std::max(1, int(std::sqrt(double(facets_.size()))));
    cells_.resize(std::size_t(count_) * count_);
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      int from[2] = {count_, count_}, to[2] = {0, 0};
      for (const std::int32_t p : facets_[f])
        for (int i = 0; i < 2; ++i) {
          const int at = cell(i, points_[std::size_t(p)][std::size_t(i)]);
          from[i] = std::min(from[i], at), to[i] = std::max(to[i], at);
        }
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) cells_[std::size_t(j) * count_ + i].push_back(f);
    }
  }
  const Point& low() const { return low_; }
  const Point& high() const { return high_; }

  /// Returns the sorted heights at which a vertical line crosses the surface. A facet counts if the line is on the same
  /// side of its three edges. The side of an edge is computed from the point with the smaller number, so that the
  /// facets on both sides of the edge agree and a closed surface is crossed an even number of times.
  std::vector<double> crossings(double x, double y) const {
    std::vector<double> out;
    if (x < low_[0] || x > high_[0] || y < low_[1] || y > high_[1]) return out;
    for (const std::size_t f : cells_[std::size_t(cell(1, y)) * count_ + cell(0, x)]) {
      double area[3];
      bool positive[3];
      for (std::size_t e = 0; e < 3; ++e) {
        std::int32_t a = facets_[f][e], b = facets_[f][(e + 1) % 3];
        const bool swapped = a > b;
        if (swapped) std::swap(a, b);
        const Point &p = points_[std::size_t(a)], &q = points_[std::size_t(b)];
        const double side = (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
        positive[e] = (side > 0) != swapped;
        area[e] = swapped ? -side : side;
      }
      if (positive[0] != positive[1] || positive[1] != positive[2]) continue;
      const double sum = area[0] + area[1] + area[2];
      if (sum == 0) continue;  // a facet that the line sees from its edge
      double z = 0;
      for (std::size_t e = 0; e < 3; ++e) z += area[e] / sum * points_[std::size_t(facets_[f][(e + 2) % 3])][2];
      out.push_back(z);
    }
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  int cell(int axis, double x) const {
    const double low = low_[std::size_t(axis)], edge = high_[std::size_t(axis)] - low;
    return std::clamp(int((x - low) / edge * count_), 0, count_ - 1);
  }
  std::vector<Point> points_;
  std::vector<std::array<std::int32_t, 3>> facets_;
  Point low_, high_;
  int count_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

/// A shape of the library, centred at the centroid of its volume, and its intermediate dimension.
struct Template {
  macadam::Surface surface;
  double size = 0;
};

Template read_template(const std::string& library, const Table& table, const std::string& name) {
  for (const auto& file : macadam::surface_files_in(library))
    if (file.stem() == name) {
      Template out{macadam::read_surface(file)};
      const auto measure = macadam::measure_shape(out.surface);
      out.size = measure.d_intermediate;
      for (auto& p : out.surface.points) p = p - measure.centroid;
      return out;
    }
  table.refuse(fmt::format("the shape \"{}\", expected \"sphere\" or a file of {} without its ending", name, library));
}

/// Returns the points of a surface after scaling, rotation by a unit quaternion (w, x, y, z) and translation.
std::vector<Point> placed(const macadam::Surface& surface, double scale, const std::array<double, 4>& q,
                          const Point& centre) {
  std::vector<Point> out;
  for (const auto& p : surface.points) {
    const macadam::Vec3d axis{q[1], q[2], q[3]}, turned = 2 * cross(axis, p);
    const macadam::Vec3d r = p + q[0] * turned + cross(axis, turned);
    out.push_back({centre[0] + scale * r.x, centre[1] + scale * r.y, centre[2] + scale * r.z});
  }
  return out;
}

}  // namespace

std::vector<Body> read_balls(const std::string& file) {
  std::vector<Body> out;
  for (Table table(file); table.next();) out.push_back(ball(table.point(), table.positive("radius")));
  return out;
}

std::vector<Body> read_aggregates(const std::string& file, const std::string& library) {
  std::vector<Body> out;
  std::map<std::string, Template> templates;
  for (Table table(file); table.next();) {
    const std::string name = table.text("shape");
    const double size = table.positive("size");
    if (name == "sphere") {
      out.push_back(ball(table.point(), size / 2));
      continue;
    }
    if (!templates.contains(name)) templates[name] = read_template(library, table, name);
    const Template& of = templates[name];
    std::array<double, 4> q{table.number("qw"), table.number("qx"), table.number("qy"), table.number("qz")};
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (std::abs(norm - 1) > 1e-6) table.refuse(fmt::format("a quaternion of norm {}, expected 1", norm));
    const auto surface =
        std::make_shared<const PlacedSurface>(placed(of.surface, size / of.size, q, table.point()), of.surface.facets);
    out.push_back(
        {surface->low(), surface->high(), [surface](double x, double y) { return surface->crossings(x, y); }});
  }
  return out;
}

}  // namespace macadam::continuum
