// SPDX-License-Identifier: GPL-3.0-or-later
/// \file power_diagram.hpp  The regular triangulation of the spheres and its dual as plain arrays (no CGAL types).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// One cell of the regular triangulation.
struct Tetrahedron {
  std::array<std::int32_t, 4> site;       ///< particle numbers; negative: a bounding site far outside the box
  std::array<std::int32_t, 4> neighbour;  ///< tetrahedron across the face opposite to site k; −1 outside the hull
};

/// Regular triangulation (weights R²) of particles and bounding sites, with its dual points.
struct PowerDiagram {
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Vec3d> dual;  ///< point of equal power to the four sites of each tetrahedron [m]
};

/// Triangulates the particles with `active[i] != 0`. Particles without a cell in all of space appear in no tetrahedron.
/// Around an edge between two particles every tetrahedron is finite. Same input, same arrays, any number of threads.
PowerDiagram power_diagram(const Specimen& specimen, const std::vector<std::uint8_t>& active);

}  // namespace macadam
