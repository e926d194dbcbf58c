// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_numbers.hpp  What every routine on surfaces asks of their numbers.
#pragma once

#include <limits>
#include <span>

#include "macadam/shape.hpp"

namespace macadam {

/// \throws InputError naming surface and point where a coordinate is not finite or so large that volumes overflow.
void require_sound_points(const Surface& surface);

/// \throws InputError naming surface and point or facet where a coordinate is not finite or a facet names no point.
void require_sound_numbers(const Surface& surface);

/// Lengths below this are rounding of the coordinates [m]: turning and moving a surface leaves a few ulp of its largest
/// coordinate.
double coordinate_rounding(const std::vector<Vec3d>& points);

/// The box around points, of which there must be one.
struct Bounds {
  Vec3d low, high;
};
Bounds bounds_of(std::span<const Vec3d> points);

/// Middle of that box; sums about it lose no digits to a far origin.
Vec3d middle_of(const std::vector<Vec3d>& points);

/// Sum of the facets' areas [m²].
double surface_area(const Surface& surface);

/// Volume that the facets enclose, negative where they look inwards [m³].
double signed_volume(const Surface& surface);

}  // namespace macadam
