// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fill.hpp  Filling many scaled copies of one shape.
#pragma once

#include "host/shapes/surface_distance.hpp"
#include "host/spheres/random_stream.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Fills copies of a shape with spheres. What depends on the shape alone is made once; filling is const, so several
/// threads may fill copies of one shape at a time.
class ShapeFiller {
 public:
  /// \throws InputError naming the surface where it is faulty.
  explicit ShapeFiller(const Surface& surface);

  /// The number of spheres for a copy `scale` times as large: those of mean volume that make up 1 − porosity of it.
  /// Below `spec.least`, fill() gives a single one. \throws InputError for an impossible spec or scale.
  std::int64_t spheres(double scale, const FillSpec& spec) const;

  /// Radius of the sphere that stands for the shape itself by a rule [m].
  double single_radius(SingleSphere rule) const;

  const ShapeMeasure& measure() const { return measure_; }

  /// Whether a point, in the surface's own frame and scale, lies within.
  bool contains(const Vec3d& point) const {
    return distance_.may_contain(point) && distance_.below(point, 0).depth > 0;
  }

  /// Whether a point, in the surface's own frame and scale, may be within `reach` of the surface or inside.
  bool may_reach(const Vec3d& point, double reach) const;

  /// Signed distance of a point outside the surface, in its own frame and scale, and the way out.
  WallDepth above(const Vec3d& point) const;

  /// fill_shape() of a copy `scale` times as large about the origin of the surface's frame. `spec` is of the copy.
  /// \throws InputError for an impossible spec or scale; RunError where spheres remain without a Laguerre cell.
  MultiSphere fill(double scale, const FillSpec& spec) const;

 private:
  Vec3d position(double radius, RandomStream& random) const;

  std::string name_;
  ShapeMeasure measure_;
  SurfaceDistance distance_;
};

/// The cluster as the mastic of a box from `low` to `high`, moved so that `low` is the origin.
Specimen in_box(const MultiSphere& cluster, const Vec3d& low, const Vec3d& high);

}  // namespace macadam
