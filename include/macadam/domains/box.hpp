// SPDX-License-Identifier: GPL-3.0-or-later
/// \file box.hpp  Defines the box: six flat walls.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "macadam/domains/parts.hpp"

namespace macadam::domains {

/// The whole bounding box. Its walls are −x +x −y +y −z +z; the last two are the platens.
struct Box {
  static constexpr const char* name = "box";
  static constexpr std::array<Dimension, 0> keys{};
  static constexpr bool is_box = true, has_uniform_section = true;
  static constexpr int prism_axis = 2;
  static constexpr unsigned flat_walls = 0b111111;

  static Sized<Box> of(const std::vector<double>& edges) { return {{edges.at(0), edges.at(1), edges.at(2)}, {}}; }
  std::vector<double> values(const Vec3d& size) const { return {size.x, size.y, size.z}; }

  double volume(const Vec3d& size) const { return size.x * size.y * size.z; }

  double section_area(const Vec3d& size, int axis) const { return wall_area(size, 2 * axis); }

  SmallestDimension smallest_dimension(const Vec3d& size) const {
    return {std::min({size.x, size.y, size.z}), "the smallest edge of the box"};
  }

  double signed_distance(const Vec3d& size, const Vec3d& p) const {
    const auto beyond = [](double x, double length) { return std::max(-x, x - length); };
    const double x = beyond(p.x, size.x), y = beyond(p.y, size.y), z = beyond(p.z, size.z);
    const double nearest = std::max({x, y, z});
    return nearest <= 0 ? nearest : norm(Vec3d{std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0)});
  }

  bool inside_sides(const Vec3d& /*size*/, const Vec3d& /*p*/, double /*inset*/) const { return true; }

  std::vector<SidePlane> side_planes(const Vec3d& /*size*/) const { return {}; }

  double wall_area(const Vec3d& size, int k) const {
    return k < 2 ? size.y * size.z : k < 4 ? size.z * size.x : size.x * size.y;
  }

  const char* wall_name(int k) const {
    constexpr std::array<const char*, 6> names{"-x", "+x", "-y", "+y", "-z", "+z"};
    return names[static_cast<std::size_t>(k)];
  }

  Overlap overlap(const Vec3d& size, const Vec3d& c, double radius) const {
    Overlap out;
    const auto axis = [&](double Vec3d::*x) {
      const double low = std::max(0.0, radius - c.*x), high = std::max(0.0, radius - (size.*x - c.*x));
      out.push.*x = low - high;
      out.squares.*x = low * low + high * high;
    };
    axis(&Vec3d::x), axis(&Vec3d::y), axis(&Vec3d::z);
    return out;
  }

  Vec3d pulled_inside(const Vec3d& size, const Vec3d& p) const {
    const auto inside = [](double x, double length) { return std::clamp(x, 1e-3 * length, 0.999 * length); };
    return {inside(p.x, size.x), inside(p.y, size.y), inside(p.z, size.z)};
  }

  const char* expected_size(const Vec3d& /*size*/) const { return nullptr; }

  std::string dimensions(const Vec3d& size) const {
    char text[160];
    std::snprintf(text, sizeof text, "box of %g x %g x %g m", size.x, size.y, size.z);
    return text;
  }

  std::string position(const Vec3d& /*size*/) const { return "with one corner at the origin"; }
};

}  // namespace macadam::domains
