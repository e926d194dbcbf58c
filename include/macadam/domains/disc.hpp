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
/// middle of the box. Loads across it act along z. Its walls are the side (the number of the wall −x) and the faces −y
/// and +y. In the tessellation 360 planes represent the side, as for an upright cylinder (cylinder.hpp).
struct Disc : PrismAlongY<Disc> {
  static constexpr const char* name = "disc";
  static constexpr std::array<Dimension, 2> keys{
      {{"diameter", "of a disc, whose axis is parallel to y and passes through x = z = diameter/2"},
       {"thickness", "of a disc along y"}}};
  static constexpr unsigned flat_walls = 0b001100;
  static constexpr int sides = 360;

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
    constexpr double turn = 2 * std::numbers::pi;
    const double r = 0.5 * size.x;
    std::vector<SidePlane> out;
    add_arc(out, {r, 0, r}, radius_of_corners(r, turn / sides), 0, turn, sides, 0);
    return out;
  }

  const char* wall_name(int k) const { return k == 2 ? "-y" : k == 3 ? "+y" : "side"; }

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
