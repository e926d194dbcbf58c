// SPDX-License-Identifier: GPL-3.0-or-later
// crushed_stone.cpp  Draws planes and bumps, samples vertices, and joins them to a surface.
#include "host/shapes/library/crushed_stone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/shapes/surface/convex_hull.hpp"
#include "host/shapes/library/icosahedron.hpp"

namespace macadam {
namespace {

/// Returns a uniformly distributed unit vector. Uses no functions whose results differ between mathematics libraries.
Vec3d random_direction(RandomStream& random) {
  while (true) {
    const Vec3d x{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double length = norm(x);
    if (length > 0.1 && length < 1) return (1 / length) * x;
  }
}

/// Returns x³²; root_32nd() is the inverse.
double to_the_32nd(double x) {
  for (int i = 0; i < 5; ++i) x *= x;
  return x;
}
double root_32nd(double x) {
  for (int i = 0; i < 5; ++i) x = std::sqrt(x);
  return x;
}

/// Intersection of a ray from the origin with a body, and the unit normal there.
struct Site {
  Vec3d direction, position, normal;
};

/// Returns the numbers of `count` sites; each is the site farthest from the sites chosen before it (farthest-point
/// sampling). `weight` [m] converts the difference of two unit normals into a distance.
std::vector<std::size_t> spread_out(const std::vector<Site>& sites, int count, double weight) {
  std::vector<double> gap(sites.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> chosen;
  std::size_t next = 0;
  while (static_cast<int>(chosen.size()) < count) {
    chosen.push_back(next);
    const Site& last = sites[next];
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const Vec3d way = sites[i].position - last.position, turn = sites[i].normal - last.normal;
      gap[i] = std::min(gap[i], dot(way, way) + weight * weight * dot(turn, turn));
    }
    next = std::max_element(gap.begin(), gap.end()) - gap.begin();
  }
  return chosen;
}

}  // namespace

void Stretching::stretch(const std::array<Vec3d, 3>& axis, const std::array<double, 3>& factor) {
  for (int c = 0; c < 3; ++c) {
    const Vec3d p = points_[c], n = normals_[c];
    for (int k = 0; k < 3; ++k) {
      points_[c] += ((factor[k] - 1) * dot(axis[k], p)) * axis[k];
      normals_[c] += ((1 / factor[k] - 1) * dot(axis[k], n)) * axis[k];
    }
  }
}

CrushedStone::CrushedStone(RandomStream& random, int faces) {
  constexpr int trials = 8;
  std::vector<Vec3d> normals;
  // Each normal is chosen among several random directions: it is the direction farthest from all normals before it.
  while (static_cast<int>(normals.size()) < faces) {
    Vec3d best{};
    double nearest = 2;
    for (int t = 0; t < trials; ++t) {
      const Vec3d candidate = random_direction(random);
      double cosine = -1;
      for (const Vec3d& n : normals) cosine = std::max(cosine, dot(n, candidate));
      if (cosine < nearest) nearest = cosine, best = candidate;
    }
    normals.push_back(best);
  }
  for (const Vec3d& n : normals) planes_.push_back((1 / random.uniform(0.75, 1.15)) * n);
  constexpr int bumps = 40;
  for (int i = 0; i < bumps; ++i) {
    const Vec3d direction = random_direction(random);
    const double width = random.uniform(0.3, 0.9);
    bumps_.push_back({direction, 0.05 * width * random.uniform(-1, 1), width * width});
  }
}

double CrushedStone::gauge(const Vec3d& x, double wear, Vec3d* gradient) const {
  double sum = 0;
  for (const Vec3d& a : planes_) sum += to_the_32nd(std::max(0.0, dot(a, x)));
  const double cut = root_32nd(sum), length = norm(x);
  *gradient = (wear / length) * x;
  for (const Vec3d& a : planes_) {
    const double height = std::max(0.0, dot(a, x));
    if (height > 0) *gradient += ((1 - wear) * to_the_32nd(height / cut) * cut / height) * a;
  }
  return (1 - wear) * cut + wear * length;
}

double CrushedStone::unevenness(const Vec3d& direction) const {
  double sum = 0;
  for (const Bump& bump : bumps_) {
    const Vec3d way = direction - bump.direction;
    const double rest = std::max(0.0, 1 - dot(way, way) / bump.width_squared);
    sum += bump.height * rest * rest;
  }
  return sum;
}

Surface CrushedStone::surface(const Stretching& stretching, double wear, int points) const {
  static const std::vector<Vec3d> directions = geodesic_sphere(4).points;  // 2562 directions
  std::vector<Site> sites;
  double size = 0;
  for (const Vec3d& u : directions) {
    Vec3d gradient;
    const double g = gauge(u, wear, &gradient);
    const Vec3d normal = stretching.normal(gradient);
    sites.push_back({u, stretching.point((1 / g) * u), (1 / norm(normal)) * normal});
    size = std::max(size, norm(sites.back().position));
  }
  Surface s;
  std::vector<Vec3d> corners;
  const std::vector<std::size_t> chosen = spread_out(sites, points, 0.3 * size);
  for (const std::size_t i : chosen) corners.push_back(sites[i].position);
  s.facets = convex_hull(corners);
  for (const std::size_t i : chosen) s.points.push_back((1 + unevenness(sites[i].direction)) * sites[i].position);
  return s;
}

}  // namespace macadam
