// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cylinder.hpp  Defines the circular cylinder with the axis along z: two platens and a curved side.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "macadam/domains/parts.hpp"

namespace macadam::domains {

/// The cylinder inscribed in the bounding box: diameter size.x = size.y, height size.z, axis through the middle of the
/// box. Its walls are the side (the number of the wall −x) and the platens −z and +z.
///
/// In the tessellation a prism with `sides` sides replaces the cylinder. The prism's section is a regular polygon with
/// the area of the circle, so platen areas and cell volumes sum to π·r² and π·r²·h up to rounding. The distance of a
/// side's middle from the axis is r·(1 − x²/6) up to terms of order x⁴, the distance of an edge is r·(1 + x²/3), with
/// x = π/sides. With 360 sides the prism's surface is at most 2.6e-5·r from the cylinder's surface.
struct Cylinder {
  static constexpr const char* name = "cylinder";
  static constexpr std::array<Dimension, 2> keys{
      {{"diameter", "of a cylinder, whose vertical axis passes through x = y = diameter/2"},
       {"height", "of a cylinder"}}};
  static constexpr bool is_box = false, has_uniform_section = true;
  static constexpr int prism_axis = 2;
  static constexpr unsigned flat_walls = 0b110000;
  static constexpr int sides = 360;

  static Sized<Cylinder> of(const std::vector<double>& v) { return {{v.at(0), v.at(0), v.at(1)}, {}}; }
  std::vector<double> values(const Vec3d& size) const { return {size.x, size.z}; }

  double volume(const Vec3d& size) const { return circle_area(size) * size.z; }

  double section_area(const Vec3d& size, int axis) const { return axis == 2 ? circle_area(size) : size.x * size.z; }

  /// Returns the polar moment of the section, π·r⁴/2 [m⁴].
  double torsion_constant(const Vec3d& size) const { return circle_area(size) * size.x * size.x / 8; }

  SmallestDimension smallest_dimension(const Vec3d& size) const {
    return {std::min(size.x, size.z), "the smaller of diameter and height"};
  }

  double signed_distance(const Vec3d& size, const Vec3d& p) const {
    const double side = from_axis(size, p) - 0.5 * size.x, end = std::max(-p.z, p.z - size.z);
    return side > 0 && end > 0 ? std::hypot(side, end) : std::max(side, end);
  }

  bool inside_sides(const Vec3d& size, const Vec3d& p, double inset) const {
    return from_axis(size, p) <= 0.5 * size.x - inset;
  }

  std::vector<SidePlane> side_planes(const Vec3d& size) const {
    std::vector<SidePlane> out;
    const double middle = 0.5 * size.x, inner = inner_radius(size);
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5) / sides;
      const Vec3d n{std::cos(angle), std::sin(angle), 0};
      out.push_back({{n, middle * (n.x + n.y) + inner}});
    }
    return out;
  }

  double wall_area(const Vec3d& size, int k) const {
    if (k >= 4) return circle_area(size);
    return k == 0 ? 2 * circle_area(size) / inner_radius(size) * size.z : 0;  // the area of a polygon is a·U/2
  }

  const char* wall_name(int k) const { return k == 4 ? "-z" : k == 5 ? "+z" : "side"; }

  Overlap overlap(const Vec3d& size, const Vec3d& c, double radius) const {
    Overlap out;
    const double rho = from_axis(size, c), depth = std::max(0.0, radius - (0.5 * size.x - rho));
    if (depth > 0 && rho > 0) {
      out.push.x = depth / rho * (0.5 * size.x - c.x);
      out.push.y = depth / rho * (0.5 * size.x - c.y);
      out.squares.x = depth * depth;
    }
    const double low = std::max(0.0, radius - c.z), high = std::max(0.0, radius - (size.z - c.z));
    out.push.z = low - high;
    out.squares.z = low * low + high * high;
    return out;
  }

  Vec3d pulled_inside(const Vec3d& size, const Vec3d& p) const {
    const double r = 0.5 * size.x, rho = from_axis(size, p), most = 0.998 * r;
    const double shrink = rho > most ? most / rho : 1;
    return {r + shrink * (p.x - r), r + shrink * (p.y - r), std::clamp(p.z, 1e-3 * size.z, 0.999 * size.z)};
  }

  const char* expected_size(const Vec3d& size) const {
    return size.x == size.y ? nullptr : "equal edges along x and y, because the section is a circle";
  }

  std::string dimensions(const Vec3d& size) const {
    char text[160];
    std::snprintf(text, sizeof text, "cylinder with a diameter of %g m and a height of %g m", size.x, size.z);
    return text;
  }

  std::string position(const Vec3d& size) const {
    return "whose axis is x = y = " + shortest_text(0.5 * size.x) + " m";
  }

  /// Returns the distance of a side's middle from the axis [m]: √(A / (n·tan(π/n))).
  double inner_radius(const Vec3d& size) const {
    return std::sqrt(circle_area(size) / (sides * std::tan(std::numbers::pi / sides)));
  }

 private:
  static double circle_area(const Vec3d& size) { return std::numbers::pi / 4 * size.x * size.x; }

  static double from_axis(const Vec3d& size, const Vec3d& p) {
    return std::hypot(p.x - 0.5 * size.x, p.y - 0.5 * size.x);
  }
};

}  // namespace macadam::domains
