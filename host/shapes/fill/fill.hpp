// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fill.hpp  Fills scaled copies of one shape with spheres.
#pragma once

#include "host/shapes/surface/surface_distance.hpp"
#include "host/spheres/random_stream.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Fills scaled copies of a shape with spheres. Everything that depends on the shape only is computed once, in the
/// constructor. Filling is const, so several threads may fill copies of one shape at the same time.
class ShapeFiller {
 public:
  /// Measures the surface and prepares the computation of distances from it. \throws InputError naming the surface if
  /// check_surface() finds a fault.
  explicit ShapeFiller(const Surface& surface);

  /// Returns the number of spheres for a copy scaled by `scale`: the volume (1 − porosity)·V of the copy divided by the
  /// mean volume of a sphere, rounded (model (20.3)). If this number is below `spec.least`, fill() gives a single
  /// sphere. \throws InputError for an invalid spec or scale.
  std::int64_t spheres(double scale, const FillSpec& spec) const;

  /// Returns the radius of the single sphere by which this rule represents the unscaled shape [m].
  double single_radius(SingleSphere rule) const;

  const ShapeMeasure& measure() const { return measure_; }

  /// Returns whether a point, in the frame and scale of the surface, lies inside the surface.
  bool contains(const Vec3d& point) const {
    return distance_.may_contain(point) && distance_.below(point, 0).depth > 0;
  }

  /// Returns false only if a point, in the frame and scale of the surface, is farther than `reach` [m] outside of the
  /// surface. Tests the bounding sphere and box only, so a point for which it returns true may be farther away.
  bool may_reach(const Vec3d& point, double reach) const;

  /// Returns the height of a point above the surface (negative inside) and the outward direction, in the frame and
  /// scale of the surface [m].
  WallDepth above(const Vec3d& point) const;

  /// Fills a copy of the shape with spheres, as fill_shape() does. The copy is scaled by `scale` about the origin of
  /// the surface's frame. `spec` applies to the scaled copy. \throws InputError for an invalid spec or scale; RunError
  /// if spheres remain without a Laguerre cell.
  MultiSphere fill(double scale, const FillSpec& spec) const;

 private:
  /// Returns a random position below the surface for the centre of a sphere.
  Vec3d position(double radius, RandomStream& random) const;

  std::string name_;
  ShapeMeasure measure_;
  SurfaceDistance distance_;
};

/// Returns a specimen whose mastic particles are the spheres of the cluster. The box of the specimen extends from `low`
/// to `high`; everything is shifted so that `low` becomes the origin.
Specimen in_box(const MultiSphere& cluster, const Vec3d& low, const Vec3d& high);

}  // namespace macadam
