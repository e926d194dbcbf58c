// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_solid.hpp  Exact questions to the solid inside a closed surface (CGAL behind them).
#pragma once

#include <memory>

#include "macadam/shape.hpp"

namespace macadam {

/// The solid that a closed surface bounds, with a tree over its facets. Queries may run on several threads at once.
class ShapeSolid {
 public:
  explicit ShapeSolid(const Surface& surface);
  ~ShapeSolid();
  ShapeSolid(ShapeSolid&&) noexcept;

  /// The point of the surface that is nearest to a point, to rounding.
  Vec3d nearest(const Vec3d& point) const;

  /// Distance of a point from the surface, to rounding.
  double distance(const Vec3d& point) const;

  /// Whether a point is in the solid or on its surface, by exact predicates.
  bool contains(const Vec3d& point) const;

  /// Whether a triangle touches or cuts the surface, by exact predicates.
  bool touches(const Vec3d& a, const Vec3d& b, const Vec3d& c) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace macadam
