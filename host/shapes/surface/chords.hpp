// SPDX-License-Identifier: GPL-3.0-or-later
/// \file chords.hpp  Measures the three principal lengths D^L, D^I and D^S of a surface as a calliper would (Krumbein's
/// method).
#pragma once

#include <array>

#include "macadam/shape.hpp"

namespace macadam {

/// Lengths [m] and unit directions of D^L, D^I and D^S.
struct Chords {
  std::array<double, 3> length{};
  std::array<Vec3d, 3> axis{};
};

/// Measures the three chords of a surface. The result is exact for the polyhedron, up to rounding. A chord joins two
/// points of the surface, like the jaws of a calliper. If the body is not convex, the chord may leave the body
/// between its two ends; the ends are the outermost points.
///
/// D^L is the longest distance between two vertices. D^I lies in a plane perpendicular to D^L. Such a plane cuts the
/// surface in a polygon whose corners move along edges when the plane is shifted. The squared distance of two corners
/// is therefore a convex quadratic function of the shift, and its maximum is reached in a plane where one of the two
/// corners is a vertex. D^S has a fixed direction, perpendicular to D^L and D^I. Seen along this direction, the length
/// of a chord is a linear function of position as long as the chord joins the same two facets. So the longest chord
/// lies where a vertex is projected onto a facet or where two projected edges cross.
///
/// If several D^L are equally long (a cube has four), the one with the longest D^I is taken; among several such D^I,
/// the one with the longest D^S. The lengths therefore do not depend on the orientation of the surface.
Chords measure_chords(const Surface& surface);

}  // namespace macadam
