// SPDX-License-Identifier: GPL-3.0-or-later
/// \file distance_field.hpp  Interpolates the signed distance from the surface of a shape on a grid. The
/// interpolation is fast and has a known error bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/shapes/surface/shape_solid.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Signed distance (negative inside) at the nodes of a cubic grid around a shape, with trilinear interpolation between
/// them.
class DistanceField {
 public:
  /// A signed distance, and the unit vector pointing outwards (0 where it is undefined).
  struct Value {
    double distance;
    Vec3d outward;
  };

  /// `cells` is the number of cells along the longest edge of the surface's bounding box.
  DistanceField(const Surface& surface, const ShapeSolid& solid, int cells);

  /// Returns the interpolated signed distance. Outside the grid it is a lower bound, up to the interpolation error.
  double at(const Vec3d& point) const;

  /// Returns the distance, as at() does, and its direction.
  Value value(const Vec3d& point) const;

  /// at_least() and at_most() return a lower and an upper bound of the true signed distance.
  double at_least(const Vec3d& point) const { return at(point) - error_; }
  double error() const { return error_; }  ///< difference of at() and at_least()
  double at_most(const Vec3d& point) const;

 private:
  struct Cell {
    std::size_t node;  ///< index of the node at the corner with the smallest coordinates
    Vec3d share;       ///< position within the cell, 0 … 1
    Vec3d beyond;      ///< vector from the nearest point of the grid; 0 inside the grid
  };
  Cell cell_of(const Vec3d& point) const;

  Vec3d low_;
  double edge_;
  /// Largest error of an interpolated distance. Between two points the distance changes by at most the length between
  /// them. The mean length from a point to the eight corners of its cell, weighted as in the interpolation, is at most
  /// half of the cell's diagonal.
  double error_;
  std::int64_t nx_, ny_, nz_;  ///< numbers of nodes
  std::vector<float> distance_;
};

}  // namespace macadam
