// SPDX-License-Identifier: GPL-3.0-or-later
/// \file trapezoid.hpp  Defines the trapezoidal prism of two-point bending (EN 12697-26, annex A).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "macadam/domains/prism.hpp"

namespace macadam::domains {

/// A prism along y whose profile is an isosceles trapezoid: width size.x at the base z = 0, `top_width` at the top
/// z = size.z, thickness size.y. Its walls are the inclined sides −x and +x, the faces −y and +y, the base −z and the
/// top +z. All walls are planes, so the tessellation has exactly this shape.
struct Trapezoid : PrismAlongY<Trapezoid> {
  static constexpr const char* name = "trapezoid";
  static constexpr std::array<Dimension, 4> keys{{{"base_width", "of a trapezoid along x, at z = 0"},
                                                  {"top_width", "of a trapezoid along x, at its greatest height"},
                                                  {"thickness", "of a trapezoid along y"},
                                                  {"height", "of a trapezoid"}}};
  static constexpr unsigned flat_walls = 0b111100;

  double top_width = 0;  ///< [m]

  static Sized<Trapezoid> of(const std::vector<double>& v) {
    Trapezoid shape;
    shape.top_width = v.at(1);
    return {{v.at(0), v.at(2), v.at(3)}, shape};
  }
  std::vector<double> values(const Vec3d& size) const { return {size.x, top_width, size.y, size.z}; }

  double section_area(const Vec3d& size, int axis) const {
    const double mean_width = 0.5 * (size.x + top_width);
    return axis == 0 ? size.y * size.z : axis == 1 ? size.z * mean_width : mean_width * size.y;
  }

  SmallestDimension smallest_dimension(const Vec3d& size) const {
    return {std::min({size.x, size.y, size.z}), "the smallest of base width, thickness and height"};
  }

  template <class F>
  void each_side(const Vec3d& size, const Vec3d& p, const F& f) const {
    const double t = slope(size), cosine = 1 / std::sqrt(1 + t * t);
    f(cosine * (t * p.z - p.x), Vec3d{-cosine, 0, cosine * t});
    f(cosine * (t * p.z + p.x - size.x), Vec3d{cosine, 0, cosine * t});
    f(-p.z, Vec3d{0, 0, -1});
    f(p.z - size.z, Vec3d{0, 0, 1});
  }

  double profile_distance(const Vec3d& size, const Vec3d& p) const {
    double highest = -norm(size);
    each_side(size, p, [&](double height, const Vec3d&) { highest = std::max(highest, height); });
    if (highest <= 0) return highest;
    const double cut = 0.5 * (size.x - top_width);
    const Vec3d corner[]{{0, 0, 0}, {size.x, 0, 0}, {size.x - cut, 0, size.z}, {cut, 0, size.z}};
    double nearest = norm(size) + norm(p);
    for (int k = 0; k < 4; ++k) {
      const Vec3d from = corner[k], along = corner[(k + 1) % 4] - from, to{p.x - from.x, 0, p.z - from.z};
      const double part = std::clamp(dot(to, along) / dot(along, along), 0.0, 1.0);
      nearest = std::min(nearest, norm(to - part * along));
    }
    return nearest;
  }

  std::vector<SidePlane> side_planes(const Vec3d& size) const {
    const double t = slope(size), cosine = 1 / std::sqrt(1 + t * t);
    return {{{{0, 0, 1}, size.z}, 5, true},
            {{{cosine, 0, cosine * t}, cosine * size.x}, 1, false},
            {{{0, 0, -1}, 0}, 4, true},
            {{{-cosine, 0, cosine * t}, 0}, 0, false}};
  }

  const char* wall_name(int k) const {
    constexpr std::array<const char*, 6> names{"-x", "+x", "-y", "+y", "-z", "+z"};
    return names[static_cast<std::size_t>(k)];
  }

  Vec3d pulled_inside(const Vec3d& size, const Vec3d& p) const {
    const double z = std::clamp(p.z, 1e-3 * size.z, 0.999 * size.z);
    const double t = slope(size), low = std::min(t * z + 1e-3 * top_width * std::sqrt(1 + t * t), 0.5 * size.x);
    return {std::clamp(p.x, low, size.x - low), std::clamp(p.y, 1e-3 * size.y, 0.999 * size.y), z};
  }

  const char* expected_size(const Vec3d& size) const {
    return top_width > 0 && top_width <= size.x ? nullptr : "a top width above 0 and at most the base width";
  }

  std::string dimensions(const Vec3d& size) const {
    char text[240];
    std::snprintf(text, sizeof text,
                  "trapezoid with a base width of %g m, a top width of %g m, a thickness of %g m and a height of %g m",
                  size.x, top_width, size.y, size.z);
    return text;
  }

  std::string position(const Vec3d& size) const {
    return "in the middle of x = 0 and x = " + shortest_text(size.x) + " m";
  }

 private:
  double slope(const Vec3d& size) const { return 0.5 * (size.x - top_width) / size.z; }
};

}  // namespace macadam::domains
