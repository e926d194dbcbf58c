// SPDX-License-Identifier: GPL-3.0-or-later
/// \file half_disc.hpp  Defines the half disc: the upper half of a disc, for bending of semi-circular specimens.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "macadam/domains/prism.hpp"
#include "macadam/domains/rollers.hpp"

namespace macadam::domains {

/// The upper half of a cylinder along y: diameter size.x, thickness size.y, height size.z = size.x/2. The axis of the
/// cylinder is x = size.x/2, z = 0. Its walls are the arc (the number of the wall −x), the flat side z = 0 (the number
/// of the wall +x), and the faces −y and +y. In the tessellation 180 planes represent the arc, so their distance from
/// the arc is that of an upright cylinder (cylinder.hpp). With rollers the flat side has the number of the wall −z, and
/// a strip of the arc around its crown, as wide as a roller, has the number of the wall +z.
struct HalfDisc : PrismAlongY<HalfDisc> {
  static constexpr const char* name = "half_disc";
  static constexpr std::array<Dimension, 2> keys{
      {{"diameter", "of a half disc, whose flat side is z = 0 and whose axis passes through x = diameter/2"},
       {"thickness", "of a half disc along y"}}};
  static constexpr unsigned flat_walls = 0b001100;
  static constexpr int sides = 180;  ///< planes of the arc

  Rollers rollers = {};  ///< on the flat side, and one on the crown, at x = size.x/2

  static Sized<HalfDisc> of(const std::vector<double>& v) { return {{v.at(0), v.at(1), 0.5 * v.at(0)}, {}}; }
  std::vector<double> values(const Vec3d& size) const { return {size.x, size.y}; }

  double section_area(const Vec3d& size, int axis) const {
    const double r = 0.5 * size.x;
    if (axis == 1) return 0.5 * std::numbers::pi * r * r;
    return axis == 0 ? r * size.y : std::numbers::sqrt3 * r * size.y;  // a chord at half of the radius is √3·r long
  }

  SmallestDimension smallest_dimension(const Vec3d& size) const {
    return {std::min(0.5 * size.x, size.y), "the smaller of radius and thickness"};
  }

  template <class F>
  void each_side(const Vec3d& size, const Vec3d& p, const F& f) const {
    const double r = 0.5 * size.x, x = p.x - r, rho = std::hypot(x, p.z);
    f(rho - r, rho > 0 ? Vec3d{x / rho, 0, p.z / rho} : Vec3d{});
    f(-p.z, Vec3d{0, 0, -1});
  }

  double profile_distance(const Vec3d& size, const Vec3d& p) const {
    const double r = 0.5 * size.x, x = std::abs(p.x - r), arc = std::hypot(x, p.z) - r;
    if (p.z >= 0) return arc > 0 ? arc : std::max(arc, -p.z);
    return x <= r ? -p.z : std::hypot(x - r, p.z);
  }

  std::vector<SidePlane> side_planes(const Vec3d& size) const {
    constexpr double quarter_turn = std::numbers::pi / 2;
    const double r = 0.5 * size.x;
    const Vec3d centre{r, 0, 0};
    std::vector<SidePlane> out;
    if (rollers.width == 0) {
      add_arc(out, centre, radius_of_corners(r, 2 * quarter_turn / sides), -quarter_turn, quarter_turn, sides, 0);
      out.push_back({{{0, 0, -1}, 0}, 1, false});
      return out;
    }
    // All corners have one distance from the axis, so that neighbouring arcs meet in a corner
    const double half = std::asin(rollers.width / size.x);
    const int in_strip = std::max(2, static_cast<int>(std::lround(half / quarter_turn * sides)));
    const int beside = (sides - in_strip) / 2;
    const double step = 2 * half / in_strip, step_beside = (quarter_turn - half) / beside;
    const double area = in_strip * std::sin(step) + 2 * beside * std::sin(step_beside);  // of the polygon, over R²/2
    const double corner = r * std::sqrt(2 * quarter_turn / area);
    add_arc(out, centre, corner, -quarter_turn, -half, beside, 0);
    add_arc(out, centre, corner, -half, half, in_strip, 5);
    add_arc(out, centre, corner, half, quarter_turn, beside, 0);
    out.push_back({{{0, 0, -1}, 0}, 4, false});
    return out;
  }

  /// The planes of the arc end at the edges of the strip on the crown, so its facets are not selected by position.
  bool carries(int wall, const Vec3d& at) const { return wall != 4 || rollers.touches(wall, at.x); }

  const char* wall_name(int k) const {
    constexpr std::array<const char*, 6> names{"arc", "flat side", "-y", "+y", "flat side", "crown"};
    return names[static_cast<std::size_t>(k)];
  }

  Vec3d pulled_inside(const Vec3d& size, const Vec3d& p) const {
    const double r = 0.5 * size.x, least = 1e-3 * size.x, z = std::max(p.z, least), most = 0.996 * r;
    const double rho = std::hypot(p.x - r, z), shrink = rho > most ? most / rho : 1;
    // raising z again by less than 2e-3·r leaves the point at least 2e-3·r inside the arc
    return {r + shrink * (p.x - r), std::clamp(p.y, 1e-3 * size.y, 0.999 * size.y), std::max(shrink * z, least)};
  }

  const char* expected_size(const Vec3d& size) const {
    return size.x == 2 * size.z ? nullptr
                                : "an edge along x of twice the edge along z, because the profile is half a circle";
  }

  std::string dimensions(const Vec3d& size) const {
    char text[160];
    std::snprintf(text, sizeof text, "half disc with a diameter of %g m and a thickness of %g m", size.x, size.y);
    return text;
  }

  std::string position(const Vec3d& size) const {
    return "above z = 0, whose axis passes through x = " + shortest_text(0.5 * size.x) + " m";
  }
};

}  // namespace macadam::domains
