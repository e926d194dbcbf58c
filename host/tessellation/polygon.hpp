// SPDX-License-Identifier: GPL-3.0-or-later
/// \file polygon.hpp  Represents convex polygons in space: clips them by half-spaces, merges and drops vertices, and
/// computes area and centroid.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam {

using Polygon = std::vector<Vec3d>;

/// Keeps the part of `polygon` where `height(x) <= 0` (Sutherland–Hodgman algorithm; `height` must be affine). Vertices
/// within `tolerance` of the plane count as lying on it, so a polygon in the plane is kept completely. `land(x)` is
/// called for each new vertex and may move it exactly onto a plane. `scratch` is overwritten. New vertices are always
/// interpolated from the inner to the outer vertex, so that facets with a common edge get the same bits.
template <class Height, class Land>
void clip(Polygon& polygon, Polygon& scratch, double tolerance, Height height, Land land) {
  scratch.clear();
  // Returns the height of a point, 0 within the tolerance.
  const auto snapped = [&](const Vec3d& p) {
    const double h = height(p);
    return std::abs(h) <= tolerance ? 0.0 : h;
  };
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3d &p = polygon[k], &q = polygon[k + 1 < n ? k + 1 : 0];
    const double hp = snapped(p), hq = snapped(q);
    const auto crossing = [&](const Vec3d& in, double h_in, const Vec3d& out, double h_out) {
      Vec3d x = in + (h_in / (h_in - h_out)) * (out - in);
      land(x);
      scratch.push_back(x);
    };
    if (hp <= 0) scratch.push_back(p);
    if (hp < 0 && hq > 0) crossing(p, hp, q, hq);
    if (hp > 0 && hq < 0) crossing(q, hq, p, hp);
  }
  polygon.swap(scratch);
}

/// Removes vertices that lie within `tolerance` of the vertex before them; the polygon is cyclic.
inline void merge_vertices(Polygon& polygon, double tolerance) {
  const auto close = [tolerance](const Vec3d& p, const Vec3d& q) { return norm(p - q) <= tolerance; };
  polygon.erase(std::unique(polygon.begin(), polygon.end(), close), polygon.end());
  while (polygon.size() > 1 && close(polygon.back(), polygon.front())) polygon.pop_back();
}

/// Removes vertices within `tolerance` of the line between their neighbours, as long as at least three vertices remain.
inline void drop_collinear(Polygon& polygon, double tolerance) {
  for (std::size_t k = 0; k < polygon.size() && polygon.size() > 3;) {
    const std::size_t n = polygon.size();
    const Vec3d &before = polygon[k > 0 ? k - 1 : n - 1], along = polygon[k + 1 < n ? k + 1 : 0] - before;
    if (norm(cross(polygon[k] - before, along)) <= tolerance * norm(along))
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  }
}

/// Area and centroid of a polygon about a unit normal. The area is negative if the polygon runs clockwise.
struct PolygonMeasure {
  double area = 0;
  Vec3d centroid{};
  /// Largest distance of a vertex from the first vertex. This distance is between half the diameter and the diameter of
  /// the polygon.
  double extent = 0;
};

/// Measures a polygon with at least one vertex.
inline PolygonMeasure measure(const Polygon& polygon, const Vec3d& normal) {
  PolygonMeasure m;
  const Vec3d& o = polygon.front();
  Vec3d moment{};
  for (std::size_t k = 1; k < polygon.size(); ++k) {
    const Vec3d u = polygon[k] - o;
    m.extent = std::max(m.extent, norm(u));
    if (k + 1 == polygon.size()) break;
    const Vec3d v = polygon[k + 1] - o;
    const double area = 0.5 * dot(cross(u, v), normal);
    m.area += area;
    moment += area * (u + v);
  }
  m.centroid = m.area != 0 ? o + (1 / (3 * m.area)) * moment : o;
  return m;
}

}  // namespace macadam
