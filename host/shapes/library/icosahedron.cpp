// SPDX-License-Identifier: GPL-3.0-or-later
/// \file icosahedron.cpp  Builds the icosahedron and divides its facets.
#include "host/shapes/library/icosahedron.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "host/shapes/surface/unit_vector.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

Surface icosahedron() {
  // The points are the corners of three golden rectangles, one in each coordinate plane; g is the golden ratio.
  const double g = (1 + std::sqrt(5.0)) / 2;
  Surface s;
  for (const Vec3d& p : {Vec3d{-1, g, 0},
                         {1, g, 0},
                         {-1, -g, 0},
                         {1, -g, 0},
                         {0, -1, g},
                         {0, 1, g},
                         {0, -1, -g},
                         {0, 1, -g},
                         {g, 0, -1},
                         {g, 0, 1},
                         {-g, 0, -1},
                         {-g, 0, 1}}) {
    s.points.push_back(unit(p));
  }
  s.facets = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
              {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
              {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return s;
}

/// Divides every facet into four. The midpoints of edges are moved outwards onto the unit sphere.
Surface subdivided(Surface s) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(s.points.size()));
    if (is_new) s.points.push_back(unit(s.points[a] + s.points[b]));
    return entry->second;
  };
  std::vector<std::array<std::int32_t, 3>> finer;
  for (const auto& [a, b, c] : s.facets) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& facet : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) finer.push_back(facet);
  }
  s.facets = std::move(finer);
  return s;
}

}  // namespace

Surface geodesic_sphere(int levels) {
  Surface s = icosahedron();
  for (int i = 0; i < levels; ++i) s = subdivided(std::move(s));
  return s;
}

Surface subdivided_icosahedron(double radius) {
  if (!(std::isfinite(radius) && radius > 0))
    throw InputError("icosahedron", 0, "radius", fmt::format("{} m", radius), "a finite radius above 0");
  Surface s = geodesic_sphere(1);
  s.name = "icosahedron";
  for (Vec3d& p : s.points) p = radius * p;
  return s;
}

}  // namespace macadam
