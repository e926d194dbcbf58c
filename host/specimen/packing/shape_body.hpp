// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_body.hpp  Represents rigid aggregates in space, and tests and finds contacts between two of them.
#pragma once

#include <vector>

#include "host/specimen/packing/distance_field.hpp"
#include "host/specimen/packing/rotation.hpp"
#include "host/specimen/packing/shape_placement.hpp"
#include "host/specimen/packing/sphere_cluster.hpp"
#include "host/shapes/surface/shape_solid.hpp"
#include "host/specimen/packing/surface_samples.hpp"

namespace macadam {

/// A template (a shape whose scaled copies are placed), with all data for testing these copies. Lengths are in the
/// frame of the template [m].
struct ShapeGeometry {
  explicit ShapeGeometry(const ShapeTemplate& shape);

  const ShapeTemplate& shape;
  ShapeSolid solid;
  DistanceField field;
  SurfaceSamples samples;
  std::vector<double> facet_reach;  ///< for each facet: longest edge at its first corner
  double radius;                    ///< radius of the ball about the centroid that contains the shape
  double inner;                     ///< radius of a ball about the centroid inside the shape; 0 if none is known
};

/// A scaled copy of a shape, or a sphere, at a position in the box.
struct ShapeBody {
  const ShapeGeometry* geometry = nullptr;
  /// The spheres that fill the body, at full scale. If present, they are tested in place of the surface.
  const SphereCluster* cluster = nullptr;
  bool sphere = false;
  double size = 0;   ///< D^I at full scale [m]
  double scale = 0;  ///< factor for lengths of the template
  Vec3d centre{};    ///< [m]
  Quaternion turn{1, 0, 0, 0};
  Rotation rotation{};

  ShapeBody() = default;
  ShapeBody(const ShapeGeometry& geometry, double size, bool sphere)
      : geometry(&geometry), sphere(sphere), size(size), scale(size / geometry.shape.d_intermediate) {}

  void set_turn(const Quaternion& q) { turn = q, rotation = Rotation(q); }
  double sphere_radius() const { return scale * geometry->shape.d_intermediate / 2 * geometry->shape.sphere_size; }
  /// radius() is the radius of a ball about the centre that contains the body; inner_radius() is the radius of a ball
  /// about the centre that lies inside the body [m].
  double radius() const { return sphere ? sphere_radius() : cluster ? cluster->radius() : scale * geometry->radius; }
  double inner_radius() const { return sphere ? sphere_radius() : cluster ? 0 : scale * geometry->inner; }
  /// Transform a point: from the frame of the template to the box (to_space), from the box to the frame of the template
  /// (to_own), and from the box to the frame of the cluster (to_cluster).
  Vec3d to_space(const Vec3d& own) const { return centre + scale * rotation(own); }
  Vec3d to_own(const Vec3d& space) const { return (1 / scale) * rotation.back(space - centre); }
  Vec3d to_cluster(const Vec3d& space) const { return rotation.back(space - centre); }

  /// Return a lower and an upper bound of the signed distance of a point from the surface [m]. Both are fast.
  double distance_at_least(const Vec3d& space) const;
  double distance_at_most(const Vec3d& space) const;
};

/// Returns whether two bodies touch, overlap or contain one another. The triangles of one body are transformed into the
/// frame of the other body. The test is exact except for the rounding of this transform.
bool overlap(const ShapeBody& a, const ShapeBody& b);

/// Returns whether two bodies overlap or are closer than `spacing` [m]. The test is exact for the spheres of bodies
/// with clusters. Between two surfaces a spacing above 0 is tested with the samples of each surface in the distance
/// field of the other.
bool nearer(const ShapeBody& a, const ShapeBody& b, double spacing);

/// Smallest and largest coordinates of a body relative to its centre.
struct Extent {
  Vec3d low{}, high{};
};
Extent extent(const ShapeBody& body);

/// A contact between two bodies (or a body and a wall) that are closer than a gap. Point and normal are means over all
/// samples within the gap, weighted by their depths.
struct ShapeContact {
  double depth = 0;  ///< gap minus distance at the deepest sample [m]; 0 without contact
  double clear = 0;  ///< without contact: a lower bound of distance minus gap [m]
  Vec3d point{};     ///< [m]
  Vec3d normal{};    ///< unit vector pointing from the second body to the first
};
/// Finds the contact between two bodies, or between a body and the walls.
ShapeContact contact(const ShapeBody& a, const ShapeBody& b, double gap);
ShapeContact wall_contact(const ShapeBody& body, const Domain& domain, double gap);

}  // namespace macadam
