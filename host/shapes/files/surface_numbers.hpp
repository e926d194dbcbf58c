// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_numbers.hpp  Checks points and facets of a surface, and computes rounding, bounds, area and volume.
#pragma once

#include <limits>
#include <span>

#include "macadam/shape.hpp"

namespace macadam {

/// Checks the points. \throws InputError naming the surface and the point if a coordinate is not finite or is so large
/// that volumes overflow.
void require_sound_points(const Surface& surface);

/// Checks the points (see require_sound_points()) and the facets. \throws InputError naming the surface and the point
/// or facet if the surface has no facets, a coordinate is not valid, or a facet refers to a point that does not exist.
void require_sound_numbers(const Surface& surface);

/// Returns the length below which differences count as rounding of the coordinates [m]. Rotating and moving a surface
/// causes errors of a few units in the last place of its largest coordinate; the length is 64 such units.
double coordinate_rounding(const std::vector<Vec3d>& points);

/// The bounding box of a set of points, which must not be empty.
struct PointBounds {
  Vec3d low, high;
};
PointBounds bounds_of(std::span<const Vec3d> points);

/// Returns the middle of the bounding box. Sums relative to it do not lose digits when the surface is far from the
/// origin.
Vec3d middle_of(const std::vector<Vec3d>& points);

/// Returns the sum of the areas of the facets [m²].
double surface_area(const Surface& surface);

/// Returns the volume enclosed by the facets [m³]. It is negative if the facets face inwards.
double signed_volume(const Surface& surface);

}  // namespace macadam
