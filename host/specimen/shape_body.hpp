// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_body.hpp  Rigid aggregates in space, and where two of them meet.
#pragma once

#include <vector>

#include "host/specimen/distance_field.hpp"
#include "host/specimen/rotation.hpp"
#include "host/specimen/shape_placement.hpp"
#include "host/specimen/sphere_cluster.hpp"
#include "host/shapes/shape_solid.hpp"
#include "host/specimen/surface_samples.hpp"

namespace macadam {

/// A template with all that its copies are tested with. Lengths are in its own frame [m].
struct ShapeGeometry {
  explicit ShapeGeometry(const ShapeTemplate& shape);

  const ShapeTemplate& shape;
  ShapeSolid solid;
  DistanceField field;
  SurfaceSamples samples;
  std::vector<double> facet_reach;  ///< longest edge of each facet at its first point
  double radius;                    ///< of the ball about the centroid that holds the shape
  double inner;                     ///< of a ball about the centroid that the shape holds; 0 where there is none
};

/// A scaled copy of a shape, or a sphere.
struct ShapeBody {
  const ShapeGeometry* geometry = nullptr;
  const SphereCluster* cluster = nullptr;  ///< its spheres at full scale, which stand for its surface where given
  bool sphere = false;
  double size = 0;   ///< D^I at full scale [m]
  double scale = 0;  ///< of the template's lengths
  Vec3d centre{};    ///< [m]
  Quaternion turn{1, 0, 0, 0};
  Rotation rotation{};

  ShapeBody() = default;
  ShapeBody(const ShapeGeometry& geometry, double size, bool sphere)
      : geometry(&geometry), sphere(sphere), size(size), scale(size / geometry.shape.d_intermediate) {}

  void set_turn(const Quaternion& q) { turn = q, rotation = Rotation(q); }
  double sphere_radius() const { return scale * geometry->shape.d_intermediate / 2 * geometry->shape.sphere_size; }
  /// Radii of balls about the centre that hold the body and that the body holds [m].
  double radius() const { return sphere ? sphere_radius() : cluster ? cluster->radius() : scale * geometry->radius; }
  double inner_radius() const { return sphere ? sphere_radius() : cluster ? 0 : scale * geometry->inner; }
  Vec3d to_space(const Vec3d& own) const { return centre + scale * rotation(own); }
  Vec3d to_own(const Vec3d& space) const { return (1 / scale) * rotation.back(space - centre); }
  Vec3d to_cluster(const Vec3d& space) const { return rotation.back(space - centre); }

  /// Bounds of the signed distance of a point from the surface [m], quickly found.
  double distance_at_least(const Vec3d& space) const;
  double distance_at_most(const Vec3d& space) const;
};

/// Whether two bodies touch, overlap or hold one another: exact for the triangles as they lie in the frame of one of
/// the two, to the rounding of that transform.
bool overlap(const ShapeBody& a, const ShapeBody& b);

/// Whether they overlap or are nearer to each other than `spacing` [m]: exact for the spheres of bodies with clusters;
/// between two surfaces a spacing above 0 is told by samples of each in the other's field.
bool nearer(const ShapeBody& a, const ShapeBody& b, double spacing);

/// Least and largest coordinates of a body about its centre.
struct Extent {
  Vec3d low{}, high{};
};
Extent extent(const ShapeBody& body);

/// Where two bodies (or a body and a wall) come closer than a gap: the mean over the samples that do, by their depths.
struct ShapeContact {
  double depth = 0;  ///< gap less distance at the deepest sample [m]; 0: no contact
  double clear = 0;  ///< without a contact: what the distance has at least beyond the gap [m]
  Vec3d point{};     ///< [m]
  Vec3d normal{};    ///< unit vector that pushes the first body away from the second
};
ShapeContact contact(const ShapeBody& a, const ShapeBody& b, double gap);
ShapeContact wall_contact(const ShapeBody& body, const Box& box, double gap);

}  // namespace macadam
