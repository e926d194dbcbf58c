// SPDX-License-Identifier: GPL-3.0-or-later
/// \file crushed_stone.hpp  One body with the flat faces, worn edges and slight unevenness of a crushed stone.
#pragma once

#include <array>
#include <vector>

#include "host/spheres/random_stream.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// A linear map that is a product of stretches, and its inverse transposed, which turns normals.
class Stretching {
 public:
  /// Further stretches by `factor[k]` along `axis[k]`, three unit vectors perpendicular to each other.
  void stretch(const std::array<Vec3d, 3>& axis, const std::array<double, 3>& factor);
  Vec3d point(const Vec3d& x) const { return image(points_, x); }
  Vec3d normal(const Vec3d& n) const { return image(normals_, n); }

 private:
  using Columns = std::array<Vec3d, 3>;
  static Vec3d image(const Columns& c, const Vec3d& x) { return x.x * c[0] + x.y * c[1] + x.z * c[2]; }

  Columns points_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, normals_ = points_;
};

/// A stone is the body {g ≤ 1} of the gauge
///
///   g(x) = (1 − w) · (Σᵢ max(0, aᵢ·x)³²)^(1/32) + w · |x|,
///
/// stretched. Its first part is what random planes aᵢ·x = 1 cut off, the edges slightly blunted by the high power; the
/// second, a sphere, makes faces bulge and edges round the more, the greater the wear w. {g ≤ 1} is strictly convex for
/// w > 0, as |x| is.
///
/// Points are strewn over the body by the farthest-point rule in position and normal, so that they crowd where it
/// bends, and joined as their convex hull. A smooth random field then shifts them along their rays, which leaves some
/// faces hollow. All facets keep being seen from the origin, each in its own cone: such a surface is closed and cannot
/// intersect itself, whatever the field and the stretching.
class CrushedStone {
 public:
  /// Draws the planes, as many as `faces`, and the field.
  CrushedStone(RandomStream& random, int faces);

  /// Points and 2·points − 4 facets. `wear` in (0, 1].
  Surface surface(const Stretching& stretching, double wear, int points) const;

 private:
  struct Bump {
    Vec3d direction;
    double height, width_squared;
  };

  double gauge(const Vec3d& x, double wear, Vec3d* gradient) const;
  double unevenness(const Vec3d& direction) const;

  std::vector<Vec3d> planes_;  ///< aᵢ: normal over distance
  std::vector<Bump> bumps_;
};

}  // namespace macadam
