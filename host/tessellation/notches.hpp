// SPDX-License-Identifier: GPL-3.0-or-later
/// \file notches.hpp  Cuts facets by notches, and checks that notches leave a specimen in one piece.
///
/// The facets between the particles on the two sides of a plane form one surface. Every such facet is perpendicular to
/// the line of the two centres, so its normal points from one side of the plane to the other, and a line along the
/// axis crosses the surface once, if it crosses cells of particles on both sides. Except within the cells at a wall,
/// the projections of the facets therefore cover the section of a box without gaps or overlaps, and the areas of a cut
/// are exact.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/tessellation/polygon.hpp"
#include "macadam/notch.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Returns the coordinate of a point along an axis (0 to 2) [m].
inline double along(const Vec3d& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Returns whether two points lie on opposite sides of the plane of a notch. The upper side includes the plane.
inline bool separates(const Notch& notch, const Vec3d& a, const Vec3d& b) {
  return (along(a, notch.axis) < notch.position) != (along(b, notch.axis) < notch.position);
}

/// Returns the parts of convex polygons that a notch leaves, as convex polygons. Vertices within `tolerance` [m] of the
/// edge of the notch count as lying on it.
std::vector<Polygon> outside_of(const Notch& notch, std::span<const Polygon> parts, double tolerance);

/// Returns for messages for example "a notch at x = 0.075 m".
std::string words_of(const Notch& notch);

/// Returns the notches with limits removed that lie on the bounding box of the domain or beyond it. \throws InputError,
/// naming the notch, if a notch lies outside the domain, or if the notches of one plane cover a whole section.
std::vector<Notch> checked_notches(const Domain& domain, std::span<const Notch> notches);

}  // namespace macadam
