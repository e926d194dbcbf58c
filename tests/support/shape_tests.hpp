// SPDX-License-Identifier: GPL-3.0-or-later
// shape_tests.hpp  Independent brute-force checks for placed shapes: crossing triangles, solid angles, distances,
// evenness of directions.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/specimen/packing/shape_placement.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {

/// Returns the surface of an aggregate at its place in the box; an empty surface if the aggregate is a sphere.
inline Surface placed_surface(const PlacedAggregate& a, const std::vector<ShapeTemplate>& shapes) {
  return a.sphere ? Surface{} : mapped(shapes[a.shape].surface, a.pose);
}

/// Returns whether the segment from p to q crosses the triangle a, b, c (Möller–Trumbore).
inline bool crosses(const Vec3d& p, const Vec3d& q, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d way = q - p, e1 = b - a, e2 = c - a, h = cross(way, e2);
  const double det = dot(e1, h);
  if (det == 0) return false;
  const Vec3d s = p - a, k = cross(s, e1);
  const double u = dot(s, h) / det, v = dot(way, k) / det, t = dot(e2, k) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
}

/// Returns how often a closed surface winds around a point, from the solid angles of its facets (Van Oosterom and
/// Strackee).
inline double winding(const Surface& s, const Vec3d& p) {
  double angle = 0;
  for (const auto& f : s.facets) {
    const Vec3d a = s.points[f[0]] - p, b = s.points[f[1]] - p, c = s.points[f[2]] - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

/// Returns the distance of a point from a segment.
inline double segment_distance(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d e = b - a;
  const double t = std::clamp(dot(p - a, e) / dot(e, e), 0.0, 1.0);
  return norm(p - a - t * e);
}

/// Returns the distance of a point from a triangle: along the normal if the foot of the perpendicular is inside,
/// otherwise to the nearest edge.
inline double triangle_distance(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d n = cross(b - a, c - a), d = p - a;
  const bool above =
      dot(cross(b - a, d), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0;
  if (above) return std::abs(dot(d, n)) / norm(n);
  return std::min({segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

/// Returns the signed distance of a point from a closed surface, positive outside, by trying every facet.
inline double signed_distance(const Surface& s, const Vec3d& p) {
  double least = norm(s.points.front() - p);
  for (const auto& f : s.facets)
    least = std::min(least, triangle_distance(p, s.points[f[0]], s.points[f[1]], s.points[f[2]]));
  return winding(s, p) > 0.5 ? -least : least;
}

/// Returns whether two aggregates overlap. Tests every edge against every facet, and one point of each aggregate
/// against the other.
inline bool brute_overlap(const PlacedAggregate& a, const PlacedAggregate& b,
                          const std::vector<ShapeTemplate>& shapes) {
  const auto sphere_radius = [&](const PlacedAggregate& s) {
    return s.pose.scale * shapes[s.shape].sphere_size * shapes[s.shape].d_intermediate / 2;
  };
  if (a.sphere && b.sphere) return norm(a.pose.centre - b.pose.centre) < sphere_radius(a) + sphere_radius(b);
  const Surface s = placed_surface(a, shapes), t = placed_surface(b, shapes);
  if (a.sphere) return signed_distance(t, a.pose.centre) < sphere_radius(a);
  if (b.sphere) return signed_distance(s, b.pose.centre) < sphere_radius(b);
  const auto edges_cross = [](const Surface& u, const Surface& v) {
    for (const auto& f : u.facets)
      for (int k = 0; k < 3; ++k)
        for (const auto& g : v.facets)
          if (f[k] < f[(k + 1) % 3] &&
              crosses(u.points[f[k]], u.points[f[(k + 1) % 3]], v.points[g[0]], v.points[g[1]], v.points[g[2]]))
            return true;
    return false;
  };
  return edges_cross(s, t) || edges_cross(t, s) || winding(s, t.points.front()) > 0.5 ||
         winding(t, s.points.front()) > 0.5;
}

/// Returns the Kolmogorov–Smirnov probability that values drawn uniformly from 0 … 1 are at least as uneven as
/// `values`.
inline double evenness(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double d = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    d = std::max({d, values[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - values[i]});
  const double x = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * d;  // Stephens 1970
  double p = 0;
  for (int k = 1; k <= 100; ++k) p += (k % 2 ? 2 : -2) * std::exp(-2 * k * k * x * x);
  return std::clamp(p, 0.0, 1.0);
}

/// For all placed shapes that are not spheres, takes the directions of D^L, the line between the two most distant
/// points. Returns the smallest evenness() over the three components (without sign) of these directions. The components
/// of a uniformly distributed direction are uniformly distributed.
inline double evenness_of_directions(const std::vector<PlacedAggregate>& placed,
                                     const std::vector<ShapeTemplate>& shapes) {
  std::vector<Vec3d> axis;
  for (const ShapeTemplate& t : shapes) axis.push_back(measure_shape(t.surface).axis_long);
  std::vector<double> x, y, z;
  for (const PlacedAggregate& a : placed) {
    if (a.sphere) continue;
    const Vec3d d = Pose{{}, a.pose.turn, 1}(axis[a.shape]);
    x.push_back(std::abs(d.x)), y.push_back(std::abs(d.y)), z.push_back(std::abs(d.z));
  }
  return std::min({evenness(x), evenness(y), evenness(z)});
}

/// Returns the mix "Design formulation" of Table 3 of [1], in its box.
inline SpecimenSpec design_formulation() {
  SpecimenSpec spec;
  spec.box = {{0.05, 0.05, 0.08}};
  spec.aggregate = {
      {0.0125, 0.019, 0.14, {}}, {0.0095, 0.0125, 0.11, {}}, {0.00475, 0.0095, 0.207, {}}, {0.002, 0.00475, 0.136, {}}};
  spec.mastic = MasticSpec{0.00075, 0.001, 0.05, {}};
  return spec;
}

}  // namespace macadam::test
