// SPDX-License-Identifier: GPL-3.0-or-later
/// \file facets.hpp  Makes the facets of a power diagram inside the box; defines the planes of the walls.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "host/tessellation/polygon.hpp"
#include "host/tessellation/power_diagram.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

/// The plane of the wall with the number −1 − k, k = 0…5.
struct WallPlane {
  double Vec3d::*coordinate;  ///< the coordinate that is constant on the wall
  double Vec3d::*u;           ///< u and v are the other two coordinates, in cyclic order
  double Vec3d::*v;
  double position;  ///< [m]
  double outward;   ///< −1 or +1

  WallPlane(int k, const Vec3d& box) {
    constexpr std::array<double Vec3d::*, 3> axis{&Vec3d::x, &Vec3d::y, &Vec3d::z};
    coordinate = axis[k / 2], u = axis[(k / 2 + 1) % 3], v = axis[(k / 2 + 2) % 3];
    outward = k % 2 ? 1 : -1;
    position = k % 2 ? box.*coordinate : 0;
  }

  /// Returns the signed distance of a point [m], positive outside the box.
  double height(const Vec3d& p) const { return outward * (p.*coordinate - position); }

  /// Returns the outward unit normal.
  Vec3d normal() const {
    Vec3d n{};
    n.*coordinate = outward;
    return n;
  }

  /// Sets `polygon` to the wall's rectangle, counter-clockwise about the outward normal.
  void rectangle(const Vec3d& box, Polygon& polygon) const {
    const std::array<std::pair<double, double>, 4> corner{{{0, 0}, {box.*u, 0}, {box.*u, box.*v}, {0, box.*v}}};
    polygon.assign(4, {});
    for (int c = 0; c < 4; ++c) {
      polygon[c].*coordinate = position;
      polygon[c].*u = corner[c].first;
      polygon[c].*v = corner[c].second;
    }
    if (outward < 0) std::reverse(polygon.begin(), polygon.end());
  }
};

/// The plane of equal power of two particles (model (2.1)).
struct Bisector {
  Vec3d normal;     ///< unit vector from a to b
  double distance;  ///< distance of the centres, d [m]
  double arm;       ///< h_A, from the centre of a to the plane along the normal: (d² + R_a² − R_b²)/(2d) [m]

  Bisector(const Specimen& specimen, std::int32_t a, std::int32_t b) {
    const Vec3d ab = specimen.centre[b] - specimen.centre[a];
    const double ra = specimen.radius[a], rb = specimen.radius[b];
    distance = norm(ab);
    normal = (1 / distance) * ab;
    arm = 0.5 * (distance + (ra - rb) * ((ra + rb) / distance));
  }
};

/// Returns a bound of the rounding error of a coordinate in the box [m]. A coordinate has an error of ε/2 of the box's
/// diagonal; sixteen such errors cover the few operations from a coordinate to a vertex of a facet.
inline double rounding_bound(const Vec3d& box) { return 8 * std::numeric_limits<double>::epsilon() * norm(box); }

/// Sets `facets`, `vertices` and `null_facets` of `out` to all facets inside the box, sorted as documented in struct
/// Tessellation. \throws InputError if two centres nearly coincide.
void make_facets(const Specimen& specimen, const PowerDiagram& diagram, Tessellation& out);

}  // namespace macadam
