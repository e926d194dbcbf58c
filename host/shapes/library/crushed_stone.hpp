// SPDX-License-Identifier: GPL-3.0-or-later
/// \file crushed_stone.hpp  Generates one body with the flat faces, worn edges and slight unevenness of a crushed
/// stone.
#pragma once

#include <array>
#include <vector>

#include "host/spheres/random_stream.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// A linear map composed of stretches, and its inverse transpose, which maps normals.
class Stretching {
 public:
  /// Appends a stretch by `factor[k]` along `axis[k]`; the axes are three orthogonal unit vectors.
  void stretch(const std::array<Vec3d, 3>& axis, const std::array<double, 3>& factor);
  /// Maps one point, or the direction of a normal.
  Vec3d point(const Vec3d& x) const { return image(points_, x); }
  Vec3d normal(const Vec3d& n) const { return image(normals_, n); }

 private:
  using Columns = std::array<Vec3d, 3>;
  static Vec3d image(const Columns& c, const Vec3d& x) { return x.x * c[0] + x.y * c[1] + x.z * c[2]; }

  Columns points_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, normals_ = points_;
};

/// A stone is the stretched set of the points with g(x) ≤ 1, where g is the gauge function
///
///   g(x) = (1 − w) · (Σᵢ max(0, aᵢ·x)³²)^(1/32) + w · |x|,
///
/// The first term is a polyhedron bounded by random planes aᵢ·x = 1 whose edges are slightly rounded by the high power.
/// The second term is a sphere: the greater the wear w, the more faces bulge and edges become round. For w > 0 the set
/// {g ≤ 1} is strictly convex because |x| is.
///
/// The vertices are chosen on this body by farthest-point sampling in position and normal, so that they are dense where
/// the body is strongly curved. Their convex hull gives the facets. A smooth random field then shifts each vertex along
/// its ray from the origin, which makes some faces hollow. Each facet remains visible from the origin in its own cone.
/// Such a surface is closed and cannot intersect itself, whatever the field and the stretching.
class CrushedStone {
 public:
  /// Draws `faces` random planes and the random field.
  CrushedStone(RandomStream& random, int faces);

  /// Returns a surface with `points` points and 2·points − 4 facets. `wear` is in (0, 1].
  Surface surface(const Stretching& stretching, double wear, int points) const;

 private:
  /// One term of the random field: a smooth bump on the unit sphere.
  struct Bump {
    Vec3d direction;
    double height, width_squared;
  };

  /// Returns g(x) and writes its gradient.
  double gauge(const Vec3d& x, double wear, Vec3d* gradient) const;
  /// Returns the relative shift of a vertex in this direction.
  double unevenness(const Vec3d& direction) const;

  std::vector<Vec3d> planes_;  ///< aᵢ: unit normal divided by the distance from the origin
  std::vector<Bump> bumps_;
};

}  // namespace macadam
