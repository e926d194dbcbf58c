// SPDX-License-Identifier: GPL-3.0-or-later
// square_sieve.cpp  Computes the smallest square mesh through which a grain passes in its best orientation.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/shapes/surface/convex_hull.hpp"
#include "host/shapes/files/surface_numbers.hpp"
#include "host/shapes/surface/unit_vector.hpp"
#include "macadam/ct.hpp"

namespace macadam {
namespace {

/// A point of a projected outline.
struct Flat {
  double x, y;
};

/// Returns the side of the smallest square around a convex outline in a plane. The function tries 90 orientations of
/// the square, one degree apart. The side is the larger of the outline's two widths along the axes of the square. While
/// the square turns, each width follows a sine between two orientations at which an edge of the outline lies along the
/// square. So the larger width is smallest at such an orientation, or where both widths are equal. Steps of one degree
/// find this minimum to a thousandth.
double square_around(const std::vector<Flat>& outline) {
  static const std::vector<Flat> turns = [] {
    std::vector<Flat> out;
    for (int a = 0; a < 90; ++a)
      out.push_back({std::cos(a * std::numbers::pi / 180), std::sin(a * std::numbers::pi / 180)});
    return out;
  }();
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [c, s] : turns) {
    double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
    for (const Flat& p : outline) {
      const double x = c * p.x + s * p.y, y = c * p.y - s * p.x;
      low_x = std::min(low_x, x), high_x = std::max(high_x, x), low_y = std::min(low_y, y),
      high_y = std::max(high_y, y);
    }
    best = std::min(best, std::max(high_x - low_x, high_y - low_y));
  }
  return best;
}

/// Returns the side of the smallest square opening through which the points pass along direction `way` (a unit vector).
double opening(const std::vector<Vec3d>& points, const Vec3d& way) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const Vec3d other = std::abs(way.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  Vec3d u = cross(way, other);
  u = unit(u);
  const Vec3d v = cross(way, u);
  std::vector<Kernel::Point_2> flat, hull;
  for (const Vec3d& p : points) flat.emplace_back(dot(p, u), dot(p, v));
  CGAL::convex_hull_2(flat.begin(), flat.end(), std::back_inserter(hull));
  std::vector<Flat> outline;
  for (const auto& p : hull) outline.push_back({p.x(), p.y()});
  return square_around(outline);
}

}  // namespace

double square_sieve(const Surface& surface) {
  std::vector<std::int32_t> corners;
  for (const auto& facet : convex_hull(surface.points)) corners.insert(corners.end(), facet.begin(), facet.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const Vec3d middle = middle_of(surface.points);
  std::vector<Vec3d> points;
  for (const std::int32_t c : corners) points.push_back(surface.points[static_cast<std::size_t>(c)] - middle);
  // tries directions distributed evenly over half a sphere (a spiral), then ever smaller steps around the best
  // direction
  constexpr int ways = 150;
  double best = std::numeric_limits<double>::infinity();
  Vec3d way{};
  const auto attempt = [&](Vec3d d) {
    d = unit(d);
    const double side = opening(points, d);
    if (side < best) best = side, way = d;
  };
  for (int n = 0; n < ways; ++n) {
    const double z = (n + 0.5) / ways, around = n * std::numbers::pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    attempt({r * std::cos(around), r * std::sin(around), z});
  }
  for (double step = 0.06; step > 0.004; step /= 2) {
    const Vec3d from = way;
    const Vec3d u = cross(from, std::abs(from.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}), v = cross(from, u);
    for (int a = 0; a < 8; ++a)
      attempt(from + (step * std::cos(a * std::numbers::pi / 4)) * u + (step * std::sin(a * std::numbers::pi / 4)) * v);
  }
  return best;
}

}  // namespace macadam
