// SPDX-License-Identifier: GPL-3.0-or-later
/// \file chords.hpp  The three lengths of a surface that a calliper takes, Krumbein's way.
#pragma once

#include <array>

#include "macadam/shape.hpp"

namespace macadam {

/// Lengths [m] and unit directions of D^L, D^I and D^S.
struct Chords {
  std::array<double, 3> length{};
  std::array<Vec3d, 3> axis{};
};

/// Exact for the polyhedron, to rounding. A chord joins two points of the surface as the jaws of a calliper do: where
/// the body is not convex it may leave it, and it ends at the outermost points.
///
/// D^L joins two vertices. D^I lies in a plane perpendicular to D^L; there the surface is a polygon whose corners slide
/// along edges as the plane moves, so the squared distance of two of them is a convex quadratic of the plane's offset:
/// the largest is found where one of the two corners is a vertex. D^S has a fixed direction; seen along it, its length
/// is linear wherever one facet lies before another, so the largest is found where a vertex lies on a facet or two
/// edges cross.
///
/// Where several D^L are equally long (a cube has four) the one with the longest D^I counts, of several such D^I the
/// one with the longest D^S: the lengths then do not depend on how the surface is turned.
Chords measure_chords(const Surface& surface);

}  // namespace macadam
