// SPDX-License-Identifier: GPL-3.0-or-later
/// \file power_diagram.hpp  The regular triangulation of the spheres and its dual, made part by part.
#pragma once

#include <cstdint>
#include <vector>

#include "host/tessellation/triangulation.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Regular triangulation (weights R²) of particles and bounding sites, with its dual points: tetrahedra that have a
/// particle, ordered by their corners. Neighbours are known across faces that have one.
struct PowerDiagram {
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Vec3d> dual;  ///< point of equal power to the four sites of each tetrahedron [m]
};

/// Triangulates the particles with `active[i] != 0`. Particles without a cell in all of space appear in no tetrahedron.
/// Around an edge between two particles every tetrahedron is finite. Same input, same bits, for any number of threads
/// and of parts, which are triangulated side by side (0: as many as there are threads, if they are large enough).
PowerDiagram power_diagram(const Specimen& specimen, const std::vector<std::uint8_t>& active, std::size_t parts = 0);

}  // namespace macadam
