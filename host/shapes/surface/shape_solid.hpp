// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_solid.hpp  Represents the solid inside a closed surface: finds nearest points, and tests containment and
/// intersection exactly with CGAL.
#pragma once

#include <memory>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// The solid bounded by a closed surface, with a search tree over its facets. Several threads may run queries at the
/// same time.
class ShapeSolid {
 public:
  explicit ShapeSolid(const Surface& surface);
  ~ShapeSolid();
  ShapeSolid(ShapeSolid&&) noexcept;

  /// Returns the nearest point of the surface, up to rounding.
  Vec3d nearest(const Vec3d& point) const;

  /// Returns the distance of a point from the surface, up to rounding [m].
  double distance(const Vec3d& point) const;

  /// Returns whether a point lies in the solid or on its surface. Uses exact predicates.
  bool contains(const Vec3d& point) const;

  /// Returns whether a triangle touches or intersects the surface. Uses exact predicates.
  bool touches(const Vec3d& a, const Vec3d& b, const Vec3d& c) const;

  /// Appends the fractions of the segment from a to b, 0 … 1 and in any order, at which it meets a facet. The tests for
  /// the facets are exact, so no crossing is missed; the fractions are rounded. A facet that contains a part of the
  /// segment adds nothing, because the facets around it do.
  void crossings(const Vec3d& a, const Vec3d& b, std::vector<double>& fractions) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace macadam
