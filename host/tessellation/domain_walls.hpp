// SPDX-License-Identifier: GPL-3.0-or-later
/// \file domain_walls.hpp  Describes the walls of a domain for the tessellation: planes perpendicular to an axis, and
/// the planes that represent curved sides.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "host/tessellation/polygon.hpp"
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

/// The walls of a domain. A wall is either one plane perpendicular to an axis, or a ring of planes that represent the
/// curved sides. The ring has the number wall_x_lo.
class DomainWalls {
 public:
  explicit DomainWalls(const Domain& domain) : domain_(domain), side_(domain.side_planes()) {
    for (std::size_t j = 0; j < side_.size(); ++j) {  // the edge between plane j and the next plane
      const Vec3d &n = side_[j].normal, &m = side_[j + 1 < side_.size() ? j + 1 : 0].normal;
      const double a = side_[j].offset, b = side_[j + 1 < side_.size() ? j + 1 : 0].offset, det = n.x * m.y - n.y * m.x;
      edge_.push_back({(a * m.y - b * n.y) / det, (b * n.x - a * m.x) / det, 0});
    }
  }

  const Vec3d& size() const { return domain_.size; }
  /// Returns whether wall k is one plane perpendicular to an axis.
  bool is_flat(int k) const { return side_.empty() || k >= 4; }
  /// Returns the planes of the curved sides.
  const std::vector<domains::Plane>& sides() const { return side_; }

  /// Returns whether a point may lie beyond a plane of the curved sides, or on it. The planes are less than a
  /// thousandth of the width from the curved sides.
  bool may_be_beyond_sides(const Vec3d& p) const {
    return !side_.empty() && !domain_.inside_sides(p, 1e-3 * domain_.size.x);
  }

  /// Sets `polygon` to the whole flat wall k, counter-clockwise about the outward normal.
  void whole_wall(int k, Polygon& polygon) const {
    const WallPlane wall(k, domain_.size);
    if (side_.empty()) return wall.rectangle(domain_.size, polygon);
    polygon = edge_;
    for (Vec3d& p : polygon) p.z = wall.position;
    if (wall.outward < 0) std::reverse(polygon.begin(), polygon.end());
  }

  /// Sets `polygon` to plane j of the curved sides, counter-clockwise about its normal.
  void whole_side(std::size_t j, Polygon& polygon) const {
    const Vec3d &p = edge_[j > 0 ? j - 1 : side_.size() - 1], &q = edge_[j];
    const double h = domain_.size.z;
    polygon.assign({{p.x, p.y, 0}, {q.x, q.y, 0}, {q.x, q.y, h}, {p.x, p.y, h}});
  }

  /// Sets `polygon` to the section of the domain by a plane perpendicular to an axis. `scratch` is overwritten.
  void section(const WallPlane& plane, double tolerance, Polygon& polygon, Polygon& scratch) const {
    if (side_.empty()) return plane.rectangle(domain_.size, polygon);
    if (plane.coordinate == &Vec3d::z) {
      whole_wall(plane.outward > 0 ? 5 : 4, polygon);
      for (Vec3d& p : polygon) p.z = plane.position;
      return;
    }
    plane.rectangle(domain_.size, polygon, 1e-3 * domain_.size.x);  // the edges of the sides lie beyond the box
    for (Vec3d& p : polygon) p.z = std::clamp(p.z, 0.0, domain_.size.z);
    clip_by_sides(tolerance, polygon, scratch, [&](Vec3d& p) { p.*plane.coordinate = plane.position; });
  }

  /// Clips a polygon by the planes of the curved sides. `land` is called for each new vertex (see clip()).
  template <class Land>
  void clip_by_sides(double tolerance, Polygon& polygon, Polygon& scratch, const Land& land) const {
    for (const domains::Plane& side : side_) {
      const auto height = [&side](const Vec3d& p) { return side.height(p); };
      const auto beyond = [&](const Vec3d& p) { return height(p) > tolerance; };
      if (std::any_of(polygon.begin(), polygon.end(), beyond)) clip(polygon, scratch, tolerance, height, land);
    }
  }

 private:
  Domain domain_;
  std::vector<domains::Plane> side_;
  Polygon edge_;  ///< edge_[j]: the edge between the planes j and j + 1, at z = 0
};

/// Returns the signed distance of a point from the wall of a facet [m], positive outside the domain.
inline double height_above_wall(const Domain& domain, const Facet& f, const Vec3d& p) {
  if (domain.is_box() || f.b <= wall_z_lo) return WallPlane(-1 - f.b, domain.size).height(p);
  return dot(p - f.centroid, f.normal);
}

}  // namespace macadam
