// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sphere_cluster.hpp  The spheres of one aggregate, and what touches them.
#pragma once

#include "host/spheres/sphere_grid.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Spheres about an origin, in a grid. Lengths are in their frame [m].
class SphereCluster {
 public:
  /// Questions of touches() may be asked of spheres up to a radius of `reach` [m].
  SphereCluster(MultiSphere spheres, double reach);

  const MultiSphere& spheres() const { return spheres_; }
  double radius() const { return radius_; }  ///< of the ball about the origin that holds all [m]

  /// Whether a sphere at a point touches one of these.
  bool touches(const Vec3d& point, double radius) const;

  /// Signed distance from the nearest of these that a sphere of radius `reach` might touch [m]; infinite where none is.
  double distance_at_most(const Vec3d& point) const;

 private:
  template <class Visit>
  void each_near(const Vec3d& point, const Visit& visit) const;

  MultiSphere spheres_;
  double radius_ = 0, reach_;
  Vec3d low_;
  SphereGrid grid_;
};

}  // namespace macadam
