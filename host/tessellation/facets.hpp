// SPDX-License-Identifier: GPL-3.0-or-later
/// \file facets.hpp  Makes the facets of a power diagram inside the domain.
#pragma once

#include <limits>

#include "host/tessellation/domain_walls.hpp"
#include "host/tessellation/power_diagram.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

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

/// Sets `facets`, `vertices` and `null_facets` of `out` to all facets inside the domain, sorted as documented in struct
/// Tessellation. \throws InputError if two centres nearly coincide.
void make_facets(const Specimen& specimen, const PowerDiagram& diagram, Tessellation& out);

}  // namespace macadam
