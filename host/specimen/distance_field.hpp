// SPDX-License-Identifier: GPL-3.0-or-later
/// \file distance_field.hpp  The signed distance from a shape's surface on a grid: fast, and never far from the truth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/shapes/shape_solid.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Signed distance (negative inside) at the nodes of a cubic grid around a shape, trilinear between them.
class DistanceField {
 public:
  /// A distance and the way out: unit vector, or 0 where there is none.
  struct Value {
    double distance;
    Vec3d outward;
  };

  /// `cells` along the longest edge of the surface's axis-aligned box.
  DistanceField(const Surface& surface, const ShapeSolid& solid, int cells);

  /// Interpolated signed distance; beyond the grid it is no more than the true one.
  double at(const Vec3d& point) const;

  /// The same with its direction.
  Value value(const Vec3d& point) const;

  /// Bounds of the true signed distance.
  double at_least(const Vec3d& point) const { return at(point) - error_; }
  double error() const { return error_; }  ///< what at_least() is below at()
  double at_most(const Vec3d& point) const;

 private:
  struct Cell {
    std::size_t node;  ///< number of its lower corner
    Vec3d share;       ///< place within it, 0 … 1
    Vec3d beyond;      ///< from the nearest point of the grid
  };
  Cell cell_of(const Vec3d& point) const;

  Vec3d low_;
  double edge_;
  /// No interpolated distance is farther than this from the true one: distances change by no more than the way does,
  /// and the mean way to the eight corners, by their weights, is at most half of the cell's diagonal.
  double error_;
  std::int64_t nx_, ny_, nz_;  ///< nodes
  std::vector<float> distance_;
};

}  // namespace macadam
