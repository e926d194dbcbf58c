// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sphere_cluster.hpp  Stores the spheres of one aggregate and tests quickly whether a sphere touches them.
#pragma once

#include "host/spheres/sphere_grid.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Spheres around an origin, in a grid. Lengths are in the frame of the cluster [m].
class SphereCluster {
 public:
  /// The tests are fast for spheres up to a radius of `reach` [m]; touches() tests all spheres for larger ones.
  SphereCluster(MultiSphere spheres, double reach);

  const MultiSphere& spheres() const { return spheres_; }
  double radius() const { return radius_; }  ///< radius of the ball about the origin that contains all spheres [m]

  /// Returns whether a sphere with this centre and radius touches one of the spheres.
  bool touches(const Vec3d& point, double radius) const;

  /// Returns the signed distance [m] from the point to the nearest sphere of the cluster, negative inside. Only spheres
  /// within the constructor's `reach` are searched reliably; returns infinity if it finds no sphere.
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
