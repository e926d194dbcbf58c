// SPDX-License-Identifier: GPL-3.0-or-later
/// \file disc.hpp  Defines the disc: a circular cylinder that lies on its side.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "macadam/domains/prism.hpp"

namespace macadam::domains {

/// The cylinder along y inscribed in the bounding box: diameter size.x = size.z, thickness size.y, axis through the
/// middle of the box. Loads across it act along z. Its walls are the side (the number of the wall −x), the faces −y and
/// +y and, in a test, two curved strips at the bottom and at the top (the numbers of the walls −z and +z). In the
/// tessellation planes of about one degree represent the side, as for an upright cylinder (cylinder.hpp).
struct Disc : PrismAlongY<Disc> {
  static constexpr const char* name = "disc";
  static constexpr std::array<Dimension, 2> keys{
      {{"diameter", "of a disc, whose axis is parallel to y and passes through x = z = diameter/2"},
       {"thickness", "of a disc along y"}}};
  static constexpr unsigned flat_walls = 0b001100;
  static constexpr int sides = 360;

  double strip_width = 0;  ///< width along x of the strips that load the disc [m]; 0: no strips

  static Sized<Disc> of(const std::vector<double>& v) { return {{v.at(0), v.at(1), v.at(0)}, {}}; }
  std::vector<double> values(const Vec3d& size) const { return {size.x, size.y}; }

  double section_area(const Vec3d& size, int axis) const {
    return axis == 1 ? std::numbers::pi / 4 * size.x * size.x : size.x * size.y;
  }

  SmallestDimension smallest_dimension(const Vec3d& size) const {
    return {std::min(size.x, size.y), "the smaller of diameter and thickness"};
  }

  template <class F>
  void each_side(const Vec3d& size, const Vec3d& p, const F& f) const {
    const double r = 0.5 * size.x, x = p.x - r, z = p.z - r, rho = std::hypot(x, z);
    f(rho - r, rho > 0 ? Vec3d{x / rho, 0, z / rho} : Vec3d{});
  }

  double profile_distance(const Vec3d& size, const Vec3d& p) const {
    return std::hypot(p.x - 0.5 * size.x, p.z - 0.5 * size.x) - 0.5 * size.x;
  }

  std::vector<SidePlane> side_planes(const Vec3d& size) const {
    constexpr double half_turn = std::numbers::pi;
    const double r = 0.5 * size.x;
    const Vec3d centre{r, 0, r};
    std::vector<SidePlane> out;
    if (strip_width == 0) {
      add_arc(out, centre, radius_of_corners(r, 2 * half_turn / sides), 0, 2 * half_turn, sides, 0);
      return out;
    }
    // All corners have one distance from the axis, so that neighbouring arcs meet in a corner
    const double half = std::asin(strip_width / size.x);
    const int in_strip = std::max(2, static_cast<int>(std::lround(half / half_turn * sides)));
    const int beside = sides / 2 - in_strip;
    const double step = 2 * half / in_strip, step_beside = (half_turn - 2 * half) / beside;
    const double area = in_strip * std::sin(step) + beside * std::sin(step_beside);  // of half the polygon, over R²/2
    const double corner = r * std::sqrt(half_turn / area);
    add_arc(out, centre, corner, -half, half, in_strip, 5);
    add_arc(out, centre, corner, half, half_turn - half, beside, 0);
    add_arc(out, centre, corner, half_turn - half, half_turn + half, in_strip, 4);
    add_arc(out, centre, corner, half_turn + half, 2 * half_turn - half, beside, 0);
    return out;
  }

  const char* wall_name(int k) const {
    constexpr std::array<const char*, 6> names{"side", "side", "-y", "+y", "-z", "+z"};
    return names[static_cast<std::size_t>(k)];
  }

  Vec3d pulled_inside(const Vec3d& size, const Vec3d& p) const {
    const double r = 0.5 * size.x, rho = std::hypot(p.x - r, p.z - r), most = 0.998 * r;
    const double shrink = rho > most ? most / rho : 1;
    return {r + shrink * (p.x - r), std::clamp(p.y, 1e-3 * size.y, 0.999 * size.y), r + shrink * (p.z - r)};
  }

  const char* expected_size(const Vec3d& size) const {
    return size.x == size.z ? nullptr : "equal edges along x and z, because the profile is a circle";
  }

  std::string dimensions(const Vec3d& size) const {
    char text[160];
    std::snprintf(text, sizeof text, "disc with a diameter of %g m and a thickness of %g m", size.x, size.y);
    return text;
  }

  std::string position(const Vec3d& size) const {
    return "whose axis is x = z = " + shortest_text(0.5 * size.x) + " m";
  }
};

}  // namespace macadam::domains
