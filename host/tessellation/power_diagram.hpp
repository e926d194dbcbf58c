// SPDX-License-Identifier: GPL-3.0-or-later
/// \file power_diagram.hpp  Computes the regular triangulation of the spheres and its dual, in parts on several
/// threads.
#pragma once

#include <cstdint>
#include <vector>

#include "host/tessellation/triangulation.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// The regular triangulation (weights R²) of particles and bounding sites, and its dual points. Contains the tetrahedra
/// that have at least one particle as a corner, sorted by their corners. The neighbour across a face is known if at
/// least one corner of the face is a particle.
struct PowerDiagram {
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Vec3d> dual;  ///< for each tetrahedron, the point of equal power with respect to its four sites [m]
};

/// Triangulates the particles with `active[i] != 0`. A particle appears in no tetrahedron if it has no cell, neither
/// inside nor outside the box. All tetrahedra around an edge between two particles are finite. The same input gives the
/// same bits for any number of threads and of parts. Parts are triangulated in parallel; `parts` 0 stands for one per
/// thread, or fewer if the parts would be small.
PowerDiagram power_diagram(const Specimen& specimen, const std::vector<std::uint8_t>& active, std::size_t parts = 0);

}  // namespace macadam
