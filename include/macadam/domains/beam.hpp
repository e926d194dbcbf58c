// SPDX-License-Identifier: GPL-3.0-or-later
/// \file beam.hpp  Defines the beam: a box whose longest edge is horizontal.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "macadam/domains/box.hpp"
#include "macadam/domains/rollers.hpp"

namespace macadam::domains {

/// A box whose longest edge is along x. Its walls are the walls of a box; a bending test has rollers on the walls −z
/// and +z.
struct Beam : Box {
  static constexpr const char* name = "beam";
  static constexpr std::array<Dimension, 3> keys{
      {{"length", "of a beam along x"}, {"width", "of a beam along y"}, {"height", "of a beam"}}};

  Rollers rollers = {};  ///< below and above the beam in a bending test

  static Sized<Beam> of(const std::vector<double>& v) { return {{v.at(0), v.at(1), v.at(2)}, {}}; }

  SmallestDimension smallest_dimension(const Vec3d& size) const {
    return {std::min({size.x, size.y, size.z}), "the smallest edge of the beam"};
  }

  bool carries(int wall, const Vec3d& at) const { return rollers.touches(wall, at.x); }

  const char* expected_size(const Vec3d& size) const {
    return size.x > size.y && size.x > size.z ? nullptr : "a length greater than width and height";
  }

  std::string dimensions(const Vec3d& size) const {
    char text[200];
    std::snprintf(text, sizeof text, "beam with a length of %g m, a width of %g m and a height of %g m", size.x, size.y,
                  size.z);
    return text;
  }
};

}  // namespace macadam::domains
