// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_distance.cpp  Builds the octree of the facets that can be nearest, and determines signs from
/// angle-weighted normals.
#include "host/shapes/surface/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "host/shapes/files/surface_numbers.hpp"
#include "host/shapes/surface/unit_vector.hpp"

namespace macadam {
namespace {

constexpr int deepest_level = 4;           // the edges of these leaves are 1/16 of the box
constexpr std::size_t few_candidates = 6;  // testing this many candidates takes as long as descending one level
enum Feature { corner_0, edge_01 = 3, edge_12, edge_20, face };

double angle_between(const Vec3d& a, const Vec3d& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

Vec3d child_centre(const Vec3d& centre, const Vec3d& quarter, int k) {
  return {centre.x + (k & 1 ? quarter.x : -quarter.x), centre.y + (k & 2 ? quarter.y : -quarter.y),
          centre.z + (k & 4 ? quarter.z : -quarter.z)};
}

}  // namespace

SurfaceDistance::SurfaceDistance(const Surface& surface) {
  std::vector<Vec3d> at_point(surface.points.size());
  std::map<std::pair<std::int32_t, std::int32_t>, Vec3d> at_edge;
  const auto edge = [](std::int32_t a, std::int32_t b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (const auto& f : surface.facets) {
    Facet facet;
    for (int k = 0; k < 3; ++k) facet.corner[k] = surface.points[f[k]];
    const auto& c = facet.corner;
    const Vec3d n = facet.normal[face] = unit(cross(c[1] - c[0], c[2] - c[0]));
    for (int k = 0; k < 3; ++k) {
      at_point[f[k]] += angle_between(c[(k + 1) % 3] - c[k], c[(k + 2) % 3] - c[k]) * n;
      at_edge[edge(f[k], f[(k + 1) % 3])] += n;
    }
    facet_.push_back(facet);
  }
  for (std::size_t i = 0; i < facet_.size(); ++i) {
    const auto& f = surface.facets[i];
    for (int k = 0; k < 3; ++k) {
      facet_[i].normal[corner_0 + k] = at_point[f[k]];
      facet_[i].normal[edge_01 + k] = at_edge[edge(f[k], f[(k + 1) % 3])];
    }
  }

  const PointBounds box = bounds_of(surface.points);
  low_ = box.low, high_ = box.high;
  for (std::size_t i = 0; i < facet_.size(); ++i) all_.push_back({0, static_cast<std::int32_t>(i)});
  node_.emplace_back();
  grow(0, 0.5 * (low_ + high_), 0.5 * (high_ - low_), 0, all_, 0);
}

/// Computes the closest point of a triangle (Ericson, Real-Time Collision Detection, section 5.1.5) and the normal
/// there.
SurfaceDistance::Nearest SurfaceDistance::nearest(const Facet& facet, const Vec3d& p) {
  const auto& [a, b, c] = facet.corner;
  const auto found = [&](const Vec3d& q, int feature) {
    const Vec3d d = p - q;
    return Nearest{dot(d, d), q, facet.normal[feature]};
  };
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return found(a, corner_0);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return found(b, corner_0 + 1);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return found(a + (d1 / (d1 - d3)) * ab, edge_01);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return found(c, corner_0 + 2);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return found(a + (d2 / (d2 - d6)) * ac, edge_20);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return found(b + ((d4 - d3) / (d4 - d3 + d5 - d6)) * (c - b), edge_12);
  return found(a + (vb / (va + vb + vc)) * ab + (vc / (va + vb + vc)) * ac, face);
}

/// Searches the candidates in order. The candidates are sorted by their distance D from another point, which is `way`
/// [m] from `point`. The distance of a candidate from `point` is therefore at least D − way, and the search ends when D
/// − way exceeds the smallest distance found.
SurfaceDistance::Nearest SurfaceDistance::nearest_of(std::span<const Candidate> nearest_first, double way,
                                                     const Vec3d& point) const {
  Nearest best{std::numeric_limits<double>::infinity(), {}, {}};
  for (const auto& [distance, facet] : nearest_first) {
    const double least = std::max(0.0, distance - way);
    if (least * least > best.squared) break;
    if (const Nearest n = nearest(facet_[facet], point); n.squared < best.squared) best = n;
  }
  return best;
}

/// Makes a node. Let g be half of the cell's diagonal, and d the distance of the cell's centre from the nearest facet.
/// A point of the cell is at most g from the centre, so its nearest facet is at most d + g from the point, and at most
/// d + 2g from the centre. Only such facets are kept. `candidates` are the facets that can be nearest in the parent
/// cell. `way` [m] is the distance between the centres of the parent cell and of this cell.
void SurfaceDistance::grow(std::int32_t node, const Vec3d& centre, const Vec3d& half, int level,
                           std::span<const Candidate> candidates, double way) {
  const double g = norm(half) * (1 + 1e-9);  // enlarged, so that rounding loses no candidate
  double nearest_one = std::numeric_limits<double>::infinity();
  std::vector<Candidate> kept;
  for (const auto& [distance, facet] : candidates) {
    if (distance - way > nearest_one + 2 * g) break;
    kept.push_back({std::sqrt(nearest(facet_[facet], centre).squared), facet});
    nearest_one = std::min(nearest_one, kept.back().distance);
  }
  std::erase_if(kept, [&](const Candidate& c) { return c.distance > nearest_one + 2 * g; });
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });

  const Nearest best = nearest(facet_[kept.front().facet], centre);
  node_[node].depth = dot(centre - best.point, best.normal) > 0 ? -nearest_one : nearest_one;
  const bool wholly_outside = node_[node].depth < -g;
  if (level == deepest_level || kept.size() <= few_candidates || wholly_outside) {
    node_[node].child = -1;
    node_[node].first = static_cast<std::int32_t>(candidates_.size());
    candidates_.insert(candidates_.end(), kept.begin(), kept.end());
    node_[node].last = static_cast<std::int32_t>(candidates_.size());
    return;
  }
  const auto child = static_cast<std::int32_t>(node_.size());
  node_[node].child = child;
  node_.resize(node_.size() + 8);
  const Vec3d quarter = 0.5 * half;
  for (int k = 0; k < 8; ++k)
    grow(child + k, child_centre(centre, quarter, k), quarter, level + 1, kept, norm(quarter) * (1 + 1e-9));
}

WallDepth SurfaceDistance::below(const Vec3d& p, double reach) const {
  Vec3d centre = 0.5 * (low_ + high_), half = 0.5 * (high_ - low_);
  const Vec3d from_centre = p - centre;
  const bool in_box =
      std::abs(from_centre.x) <= half.x && std::abs(from_centre.y) <= half.y && std::abs(from_centre.z) <= half.z;
  Nearest best;
  if (in_box) {
    std::int32_t at = 0;
    while (node_[at].child >= 0) {
      const int k = (p.x > centre.x ? 1 : 0) + (p.y > centre.y ? 2 : 0) + (p.z > centre.z ? 4 : 0);
      half = 0.5 * half;
      centre = child_centre(centre, half, k);
      at = node_[at].child + k;
    }
    // The depth at p differs from the depth at the centre of the cell by at most the distance between p and the centre.
    const double way = norm(p - centre);
    if (const double least = node_[at].depth - way; least > reach) return {least, {}};
    best = nearest_of(std::span(candidates_).subspan(node_[at].first, node_[at].last - node_[at].first),
                      way * (1 + 1e-9), p);
  } else {
    best = nearest_of(all_, 0, p);
  }
  const Vec3d d = p - best.point;
  const double distance = std::sqrt(best.squared);
  const bool outside = dot(d, best.normal) > 0;
  // For a point on the surface, up to rounding, the direction is the inward normal.
  if (distance <= 1e-12 * norm(high_ - low_)) return {0, unit(-best.normal)};
  return {outside ? -distance : distance, (outside ? -1 / distance : 1 / distance) * d};
}

double SurfaceDistance::depth(const Vec3d& p) const { return below(p, std::numeric_limits<double>::infinity()).depth; }

}  // namespace macadam
