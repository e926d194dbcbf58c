// SPDX-License-Identifier: GPL-3.0-or-later
/// \file domain_walls.hpp  Describes the walls of a domain for the tessellation: planes of the bounding box, and the
/// planes that represent the other sides.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "host/tessellation/polygon.hpp"
#include "macadam/domains/prism.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

/// The plane of the wall with the number −1 − k, k = 0…5.
struct WallPlane {
  double Vec3d::*coordinate;  ///< the coordinate that is constant on the wall
  double Vec3d::*u;           ///< u and v are the other two coordinates, in cyclic order
  double Vec3d::*v;
  double position;  ///< [m]
  double outward;   ///< −1 or +1

  WallPlane(int k, const Vec3d& box) {
    constexpr std::array<double Vec3d::*, 3> axis{&Vec3d::x, &Vec3d::y, &Vec3d::z};
    coordinate = axis[k / 2], u = axis[(k / 2 + 1) % 3], v = axis[(k / 2 + 2) % 3];
    outward = k % 2 ? 1 : -1;
    position = k % 2 ? box.*coordinate : 0;
  }

  /// Returns the signed distance of a point [m], positive outside the box.
  double height(const Vec3d& p) const { return outward * (p.*coordinate - position); }

  /// Returns the outward unit normal.
  Vec3d normal() const {
    Vec3d n{};
    n.*coordinate = outward;
    return n;
  }

  /// Sets `polygon` to the wall's rectangle, counter-clockwise about the outward normal. `margin`: length by which the
  /// rectangle is wider than the box on all sides [m].
  void rectangle(const Vec3d& box, Polygon& polygon, double margin = 0) const {
    const double low = 0 - margin, u1 = box.*u + margin, v1 = box.*v + margin;  // -margin could be -0
    const std::array<std::pair<double, double>, 4> corner{{{low, low}, {u1, low}, {u1, v1}, {low, v1}}};
    polygon.assign(4, {});
    for (int c = 0; c < 4; ++c) {
      polygon[c].*coordinate = position;
      polygon[c].*u = corner[c].first;
      polygon[c].*v = corner[c].second;
    }
    if (outward < 0) std::reverse(polygon.begin(), polygon.end());
  }
};

/// The walls of a domain. A wall is either one plane of the bounding box, or consists of planes that are sides of a
/// prism.
class DomainWalls {
 public:
  explicit DomainWalls(const Domain& domain)
      : domain_(domain), ring_(domain.side_planes()), corner_(domains::profile_corners(ring_, domain.prism_axis())) {
    for (int k = 0; k < wall_count; ++k) flat_ |= static_cast<unsigned>(domain.is_flat(k)) << k;
    for (std::size_t j = 0; j < ring_.size(); ++j) {
      if (ring_[j].on_box) continue;
      side_.push_back(j);
      side_walls_ |= 1U << ring_[j].wall;
    }
  }

  const Vec3d& size() const { return domain_.size; }
  /// Returns whether wall k is one plane of the bounding box.
  bool is_flat(int k) const { return (flat_ >> k & 1U) != 0; }
  /// Returns, as bits, the walls that consist of other planes.
  unsigned side_walls() const { return side_walls_; }
  /// Returns the indices of those planes.
  const std::vector<std::size_t>& sides() const { return side_; }
  /// Returns the plane with this index.
  const domains::SidePlane& side(std::size_t j) const { return ring_[j]; }

  /// Returns whether a point may lie beyond a plane of the sides, or on it. The planes are less than a thousandth of
  /// the width from the curved sides.
  bool may_be_beyond_sides(const Vec3d& p) const {
    return !ring_.empty() && !domain_.inside_sides(p, 1e-3 * domain_.size.x);
  }

  /// Sets `polygon` to the whole flat wall k, counter-clockwise about the outward normal.
  void whole_wall(int k, Polygon& polygon) const {
    const WallPlane wall(k, domain_.size);
    if (ring_.empty()) return wall.rectangle(domain_.size, polygon);
    if (k / 2 == domain_.prism_axis()) {
      polygon = corner_;
      if (wall.outward < 0) std::reverse(polygon.begin(), polygon.end());
    } else {
      for (std::size_t j = 0; j < ring_.size(); ++j)
        if (ring_[j].on_box && ring_[j].wall == k) whole_side(j, polygon);
    }
    for (Vec3d& p : polygon) p.*wall.coordinate = wall.position;
  }

  /// Sets `polygon` to the side with the index j, counter-clockwise about its normal.
  void whole_side(std::size_t j, Polygon& polygon) const {
    const Vec3d &p = corner_[j > 0 ? j - 1 : ring_.size() - 1], &q = corner_[j];
    const WallPlane end(2 * domain_.prism_axis() + 1, domain_.size);
    polygon.assign({p, q, q, p});
    for (const std::size_t k : {0, 1}) polygon[k].*end.coordinate = 0;
    for (const std::size_t k : {2, 3}) polygon[k].*end.coordinate = end.position;
  }

  /// Sets `polygon` to the section of the domain by a plane perpendicular to an axis. `scratch` is overwritten.
  void section(const WallPlane& plane, double tolerance, Polygon& polygon, Polygon& scratch) const {
    if (ring_.empty()) return plane.rectangle(domain_.size, polygon);
    const WallPlane end(2 * domain_.prism_axis() + 1, domain_.size);
    if (plane.coordinate == end.coordinate) {
      whole_wall(2 * domain_.prism_axis() + (plane.outward > 0 ? 1 : 0), polygon);
      for (Vec3d& p : polygon) p.*end.coordinate = plane.position;
      return;
    }
    plane.rectangle(domain_.size, polygon, 1e-3 * domain_.size.x);  // the edges of the sides lie beyond the box
    for (int k = 0; k < wall_count; ++k) {
      if (!is_flat(k)) continue;
      const WallPlane wall(k, domain_.size);
      for (Vec3d& p : polygon)
        if (wall.height(p) > 0) p.*wall.coordinate = wall.position;
    }
    clip_by_sides(tolerance, polygon, scratch, [&](Vec3d& p) { p.*plane.coordinate = plane.position; });
  }

  /// Clips a polygon by the planes of the sides that are not walls of the bounding box. `land` is called for each new
  /// vertex (see clip()).
  template <class Land>
  void clip_by_sides(double tolerance, Polygon& polygon, Polygon& scratch, const Land& land) const {
    for (const std::size_t j : side_) {
      const auto height = [&plane = ring_[j]](const Vec3d& p) { return plane.height(p); };
      const auto beyond = [&](const Vec3d& p) { return height(p) > tolerance; };
      if (std::any_of(polygon.begin(), polygon.end(), beyond)) clip(polygon, scratch, tolerance, height, land);
    }
  }

 private:
  Domain domain_;
  std::vector<domains::SidePlane> ring_;  ///< all sides of the prism, also those on the bounding box
  Polygon corner_;                        ///< corner_[j]: between the planes j and j + 1, at 0 along the prism's axis
  std::vector<std::size_t> side_;         ///< indices of the planes that are not walls of the bounding box
  unsigned flat_ = 0, side_walls_ = 0;    ///< walls as bits
};

/// Returns the signed distance of a point from the wall of a facet [m], positive outside the domain.
inline double height_above_wall(const Domain& domain, const Facet& f, const Vec3d& p) {
  if (domain.is_flat(-1 - f.b)) return WallPlane(-1 - f.b, domain.size).height(p);
  return dot(p - f.centroid, f.normal);
}

}  // namespace macadam
