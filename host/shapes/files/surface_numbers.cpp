// SPDX-License-Identifier: GPL-3.0-or-later
// surface_numbers.cpp  Checks coordinates and facets, and computes rounding, bounds, area and volume.
#include "host/shapes/files/surface_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr double largest_coordinate = 1e50;  // [m]; products of three such numbers do not overflow

}  // namespace

void require_sound_points(const Surface& surface) {
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    const Vec3d& x = surface.points[p];
    if (std::abs(x.x) < largest_coordinate && std::abs(x.y) < largest_coordinate && std::abs(x.z) < largest_coordinate)
      continue;
    throw InputError(surface.name, 0, fmt::format("point {}", p), fmt::format("({}, {}, {})", x.x, x.y, x.z),
                     fmt::format("finite coordinates below {} m", largest_coordinate));
  }
}

void require_sound_numbers(const Surface& surface) {
  if (surface.facets.empty()) throw InputError(surface.name, 0, "surface", "no facet", "a closed surface");
  require_sound_points(surface);
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    for (const std::int32_t p : surface.facets[f]) {
      if (p >= 0 && static_cast<std::size_t>(p) < surface.points.size()) continue;
      throw InputError(surface.name, 0, fmt::format("facet {}", f), fmt::format("point {}", p),
                       fmt::format("a number below {}", surface.points.size()));
    }
  }
}

double coordinate_rounding(const std::vector<Vec3d>& points) {
  double magnitude = 0;
  for (const Vec3d& p : points) magnitude = std::max({magnitude, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return 64 * std::numeric_limits<double>::epsilon() * magnitude;
}

PointBounds bounds_of(std::span<const Vec3d> points) {
  Vec3d low = points.front(), high = low;
  for (const Vec3d& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {low, high};
}

Vec3d middle_of(const std::vector<Vec3d>& points) {
  const auto [low, high] = bounds_of(points);
  return 0.5 * low + 0.5 * high;
}

double surface_area(const Surface& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.facets)
    sum += norm(cross(surface.points[b] - surface.points[a], surface.points[c] - surface.points[a]));
  return sum / 2;
}

double signed_volume(const Surface& surface) {
  const Vec3d o = middle_of(surface.points);
  double sum = 0;
  for (const auto& [a, b, c] : surface.facets) {
    sum += dot(surface.points[a] - o, cross(surface.points[b] - o, surface.points[c] - o));
  }
  return sum / 6;
}

}  // namespace macadam
