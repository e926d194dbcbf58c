// SPDX-License-Identifier: GPL-3.0-or-later
/// \file prism.hpp  Defines what the prisms along y have in common, whatever their profile is.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "macadam/domains/parts.hpp"

namespace macadam::domains {

/// Returns the corners of the polygon that planes parallel to an axis (0 to 2) enclose. Corner j lies between the
/// planes j and j + 1; its coordinate along the axis is 0. Neighbouring planes must not be parallel.
inline std::vector<Vec3d> profile_corners(const std::vector<SidePlane>& planes, int axis) {
  constexpr double Vec3d::*coordinates[]{&Vec3d::x, &Vec3d::y, &Vec3d::z};
  double Vec3d::*const u = coordinates[(axis + 1) % 3];
  double Vec3d::*const v = coordinates[(axis + 2) % 3];
  std::vector<Vec3d> out(planes.size());
  for (std::size_t j = 0; j < planes.size(); ++j) {
    const SidePlane &p = planes[j], &q = planes[j + 1 < planes.size() ? j + 1 : 0];
    const double det = p.normal.*u * q.normal.*v - p.normal.*v * q.normal.*u;
    out[j].*u = (p.offset * q.normal.*v - q.offset * p.normal.*v) / det;
    out[j].*v = (q.offset * p.normal.*u - p.offset * q.normal.*u) / det;
  }
  return out;
}

/// Appends planes that represent an arc of a circular cylinder along y. Angles [rad] count from +z towards +x.
/// `corner_radius`: distance of the planes' common edges from the axis through `centre` [m].
inline void add_arc(std::vector<SidePlane>& out, const Vec3d& centre, double corner_radius, double from, double to,
                    int planes, int wall) {
  const double step = (to - from) / planes, inner = corner_radius * std::cos(0.5 * step);
  for (int k = 0; k < planes; ++k) {
    const double angle = from + step * (k + 0.5);
    const Vec3d n{std::sin(angle), 0, std::cos(angle)};
    out.push_back({{n, dot(n, centre) + inner}, wall, false});
  }
}

/// Returns the distance of the corners of a polygon from its centre [m], if sides that each span the angle `step` [rad]
/// enclose the same area as the circle's arc: r·√(step / sin(step)), which is r·(1 + step²/12) up to terms of order
/// step⁴.
inline double radius_of_corners(double radius, double step) { return radius * std::sqrt(step / std::sin(step)); }

/// Base of shapes that are prisms along y, from y = 0 to y = size.y; those two ends are the walls −y and +y. S has, in
/// addition to the members that this class lacks (DomainShape):
/// - `each_side(size, p, f)`: calls f(height, normal) for every side, with the height of the point above the side [m]
///   and the outward unit normal at the nearest point (zero if all points of the side are equally near);
/// - `profile_distance(size, p)`: distance of (p.x, p.z) from the profile [m], negative inside.
template <class S>
struct PrismAlongY {
  static constexpr bool is_box = false, has_uniform_section = false;
  static constexpr int prism_axis = 1;

  double volume(const Vec3d& size) const { return self().section_area(size, prism_axis) * size.y; }

  double signed_distance(const Vec3d& size, const Vec3d& p) const {
    const double side = self().profile_distance(size, p), end = std::max(-p.y, p.y - size.y);
    return side > 0 && end > 0 ? std::hypot(side, end) : std::max(side, end);
  }

  bool inside_sides(const Vec3d& size, const Vec3d& p, double inset) const {
    bool inside = true;
    self().each_side(size, p, [&](double height, const Vec3d&) { inside = inside && height <= -inset; });
    return inside;
  }

  double wall_area(const Vec3d& size, int k) const {
    if (k == 2 || k == 3) return self().section_area(size, prism_axis);
    const std::vector<SidePlane> planes = self().side_planes(size);
    const std::vector<Vec3d> corner = profile_corners(planes, prism_axis);
    double width = 0;
    for (std::size_t j = 0; j < planes.size(); ++j)
      if (planes[j].wall == k) width += norm(corner[j] - corner[j > 0 ? j - 1 : corner.size() - 1]);
    return width * size.y;
  }

  Overlap overlap(const Vec3d& size, const Vec3d& c, double radius) const {
    Overlap out;
    self().each_side(size, c, [&](double height, const Vec3d& normal) {
      const double depth = radius + height;
      if (!(depth > 0) || dot(normal, normal) == 0) return;
      out.push -= depth * normal;
      out.squares.x += depth * depth;
    });
    const double low = std::max(0.0, radius - c.y), high = std::max(0.0, radius - (size.y - c.y));
    out.push.y = low - high;
    out.squares.y = low * low + high * high;
    return out;
  }

 private:
  const S& self() const { return static_cast<const S&>(*this); }
};

}  // namespace macadam::domains
