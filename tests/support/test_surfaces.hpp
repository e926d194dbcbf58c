// SPDX-License-Identifier: GPL-3.0-or-later
// test_surfaces.hpp  Small closed surfaces with known measures, and ways to move and rotate them.
#pragma once

#include <algorithm>
#include <cmath>

#include "host/spheres/random_stream.hpp"
#include "host/shapes/library/icosahedron.hpp"
#include "host/specimen/packing/rotation.hpp"
#include "macadam/shape.hpp"

namespace macadam::test {

inline Surface tetrahedron(double edge = 1) {
  const double k = edge / std::sqrt(8.0);
  return {
      "tetrahedron", {{k, k, k}, {k, -k, -k}, {-k, k, -k}, {-k, -k, k}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

/// Returns a right prism along z over a polygon. The polygon is counter-clockwise and star-shaped about its first
/// point.
inline Surface prism(const std::vector<std::array<double, 2>>& base, double height) {
  Surface s{"prism", {}, {}};
  const auto n = static_cast<std::int32_t>(base.size());
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] : base) s.points.push_back({x, y, z});
  }
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t j = (i + 1) % n;
    s.facets.push_back({i, j, n + j});
    s.facets.push_back({i, n + j, n + i});
    if (i >= 1 && i + 1 < n) {
      s.facets.push_back({0, j, i});
      s.facets.push_back({n, n + i, n + j});
    }
  }
  return s;
}

inline Surface box_surface(double a, double b, double c) {
  Surface s = prism({{0, 0}, {a, 0}, {a, b}, {0, b}}, c);
  s.name = "box";
  return s;
}

/// Returns an L-shaped prism with its outer corner at the origin and its two arms, of the given length and width, along
/// x and y.
inline Surface l_surface(double length, double width, double height) {
  const double l = length, w = width;
  return prism({{0, 0}, {l, 0}, {l, w}, {w, w}, {w, l}, {0, l}}, height);
}

/// Returns the signed distance of p from the surface of the box 0 … (a, b, c), positive inside.
inline double depth_in_box(const Vec3d& p, double a, double b, double c) {
  const double x = std::max(-p.x, p.x - a), y = std::max(-p.y, p.y - b), z = std::max(-p.z, p.z - c);
  const Vec3d out{std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0)};
  return -norm(out) - std::min(std::max({x, y, z}), 0.0);
}

/// Returns a box with a square tunnel of side w along x through its middle, a surface of genus 1.
inline Surface tunnel(double a, double b, double c, double w) {
  Surface s{"tunnel", {}, {}};
  for (const double x : {0.0, a}) {
    for (const auto& [wide, high] : {std::array{b, c}, {w, w}}) {
      for (const auto& [u, v] : {std::array{-.5, -.5}, {.5, -.5}, {.5, .5}, {-.5, .5}}) {
        s.points.push_back({x, b / 2 + u * wide, c / 2 + v * high});
      }
    }
  }
  const auto quad = [&](int p, int q, int r, int t) {
    s.facets.push_back({p, q, r});
    s.facets.push_back({p, r, t});
  };
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    quad(j, i, i + 8, j + 8);            // outer faces
    quad(i + 4, j + 4, j + 12, i + 12);  // walls of the tunnel
    quad(i, j, j + 4, i + 4);            // end x = 0; seen from −x the ring runs clockwise in (y, z)
    quad(j + 8, i + 8, i + 12, j + 12);  // end x = a
  }
  for (auto& f : s.facets) std::swap(f[1], f[2]);
  return s;
}

/// Returns an icosahedron whose facets are split into four `level` times, with its points on the unit sphere.
inline Surface icosphere(int level) {
  Surface s = geodesic_sphere(level);
  s.name = "icosphere";
  return s;
}

template <class Map>
Surface mapped(Surface surface, const Map& map) {
  for (Vec3d& p : surface.points) p = map(p);
  return surface;
}

/// Returns two surfaces as one surface of two pieces.
inline Surface joined(const Surface& a, const Surface& b) {
  Surface s = a;
  s.points.insert(s.points.end(), b.points.begin(), b.points.end());
  const auto n = static_cast<std::int32_t>(a.points.size());
  for (const auto& [p, q, r] : b.facets) s.facets.push_back({n + p, n + q, n + r});
  return s;
}

/// Returns the surface shifted by `by`.
inline Surface moved(const Surface& s, const Vec3d& by) {
  return mapped(s, [&](const Vec3d& p) { return p + by; });
}

/// Returns a uniformly distributed random rotation with the given scale and centre.
inline Pose random_pose(RandomStream& random, double scale = 1, const Vec3d& centre = {}) {
  return {centre, random_turn(random), scale};
}

/// Returns an ellipsoid with random dents; it is not convex but star-shaped about the origin.
inline Surface lump(std::uint64_t seed, int level, const Vec3d& axes, double dent) {
  RandomStream random(seed, 0);
  return mapped(icosphere(level), [&](const Vec3d& p) {
    const double r = 1 - dent * random.uniform();
    return r * Vec3d{axes.x * p.x, axes.y * p.y, axes.z * p.z};
  });
}

/// Returns a stone: an ellipsoid of 1 : 0.7 : 0.45, about the average proportions of aggregates, with flat faces cut by
/// random planes.
inline Surface stone(std::uint64_t seed, int level = 2) {
  RandomStream random(seed, 0);
  const auto between = [&] { return random.uniform(-1, 1); };
  std::vector<Vec3d> planes;  // unit normal divided by the distance of the plane from the origin
  while (planes.size() < 14) {
    const Vec3d n{between(), between(), between()};
    if (dot(n, n) < 1 && dot(n, n) > 0.01) planes.push_back((1 / (random.uniform(0.75, 0.9) * norm(n))) * n);
  }
  return mapped(icosphere(level), [&](const Vec3d& p) {
    double cut = 1;
    for (const Vec3d& n : planes) cut = std::max(cut, dot(n, p));
    return (1 / cut) * Vec3d{p.x, 0.7 * p.y, 0.45 * p.z};
  });
}

}  // namespace macadam::test
