// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tessellation.hpp  The Laguerre–Voronoi diagram of a specimen, clipped exactly by its box: docs/model.md,
/// section 2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// Walls are named by negative numbers wherever a particle number may stand: −1…−6 for −x +x −y +y −z +z.
enum Wall : std::int32_t {
  wall_x_lo = -1,
  wall_x_hi = -2,
  wall_y_lo = -3,
  wall_y_hi = -4,
  wall_z_lo = -5,
  wall_z_hi = -6
};
inline constexpr int wall_count = 6;

inline constexpr const char* wall_names[wall_count] = {"-x", "+x", "-y", "+y", "-z", "+z"};

/// 0…5, in the order above: where a wall stands in arrays.
constexpr std::size_t wall_index(std::int32_t wall) { return static_cast<std::size_t>(-1 - wall); }

/// One planar convex polygon shared by the cells of `a` and `b`, or by the cell of `a` and a wall.
struct Facet {
  std::int32_t a = 0;                              ///< particle
  std::int32_t b = 0;                              ///< particle (then a < b) or Wall
  double area = 0;                                 ///< [m²]
  Vec3d centroid{};                                ///< area centroid [m]
  Vec3d normal{};                                  ///< unit, from a to b (outwards at a wall)
  std::uint32_t vertex_begin = 0, vertex_end = 0;  ///< range in Tessellation::vertices
};

/// Laguerre cells of all particles and voids (weights R²) inside the box. Voids are numbered behind the particles.
struct Tessellation {
  std::vector<Facet> facets;         ///< sorted by (a, b): walls (negative b) first among those of one a
  std::vector<Vec3d> vertices;       ///< [m]; each facet's own run, ordered counter-clockwise about its normal
  std::vector<double> cell_volume;   ///< [m³], one a particle, then one a void; 0 where hidden
  std::vector<std::int32_t> hidden;  ///< particles and voids without a cell in the box, ascending
  std::int64_t null_facets = 0;      ///< neighbours meeting only in an edge or a point (zero area): not facets

  std::span<const Vec3d> polygon(const Facet& f) const {
    return {vertices.data() + f.vertex_begin, f.vertex_end - f.vertex_begin};
  }
};

/// Builds the tessellation. Deterministic. Any position of the particles is handled, cospherical ones included.
/// \throws InputError from validate() — coincident centres, particles outside the box and the like.
Tessellation tessellate(const Specimen& specimen);

/// How far a tessellation is from what every Laguerre diagram obeys; all values would be 0 in exact arithmetic.
struct TessellationInvariants {
  double volume = 0;    ///< |Σ cell volumes − box| / box
  double closure = 0;   ///< max over cells of |Σ A·n outwards| / Σ A
  double flatness = 0;  ///< max over facets of a vertex's distance to the facet's plane / distance of the centres
  double power = 0;     ///< max over facets and vertices of |pow_a − pow_b| / distance², interior facets
  double walls = 0;     ///< max over walls of |Σ wall facets − wall| / wall
};

/// Measures the invariants (used by tests and by `macadam specimen`).
TessellationInvariants measure_invariants(const Specimen& specimen, const Tessellation& tessellation);

}  // namespace macadam
