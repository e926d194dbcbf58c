// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tessellation.hpp  Computes the Laguerre–Voronoi diagram of a specimen, clipped by its domain:
/// docs/model.md, section 2.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// Walls are represented by negative numbers wherever a particle number may stand: −1…−6 for −x +x −y +y −z +z. The
/// curved side of a cylinder, a disc or a half disc has the number −1, the flat side of a half disc −2.
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

/// Returns 0…5, in the order above: the index of a wall in arrays.
constexpr std::size_t wall_index(std::int32_t wall) { return static_cast<std::size_t>(-1 - wall); }

/// One planar convex polygon between the cells of `a` and `b`, or between the cell of `a` and a wall.
struct Facet {
  std::int32_t a = 0;                              ///< particle
  std::int32_t b = 0;                              ///< particle (then a < b) or Wall
  double area = 0;                                 ///< [m²]
  Vec3d centroid{};                                ///< area centroid [m]
  Vec3d normal{};                                  ///< unit, from a to b (outwards at a wall)
  std::uint32_t vertex_begin = 0, vertex_end = 0;  ///< range in Tessellation::vertices
};

/// Laguerre cells of all particles and voids (weights R²) inside the domain. Voids are numbered after the particles.
/// The weights of voids may differ: see `void_weight`.
struct Tessellation {
  /// Sorted by (a, b); among the facets of one a, walls (negative b) come first. A cell may have several facets on a
  /// curved side, one for each plane that represents the side (domains/parts.hpp).
  std::vector<Facet> facets;
  std::vector<Vec3d> vertices;  ///< [m]; the vertices of a facet are consecutive, counter-clockwise about its normal
  /// [m³], one per particle, then one per void; 0 for a particle or void without a cell.
  std::vector<double> cell_volume;
  std::vector<std::int32_t> hidden;  ///< particles and voids without a cell in the domain, in rising order
  /// Number of neighbours that meet only in an edge or a point (zero area); these are not facets.
  std::int64_t null_facets = 0;
  /// Weights of the voids [m²], one per void; they may be negative. Empty if the weights are the squares of the radii.
  std::vector<double> void_weight = {};

  /// Returns the vertices of a facet.
  std::span<const Vec3d> polygon(const Facet& f) const {
    return {vertices.data() + f.vertex_begin, f.vertex_end - f.vertex_begin};
  }
};

/// Builds the tessellation. The same specimen always gives the same tessellation. Works for any positions of the
/// particles, also if many centres lie on one sphere.
///
/// \throws InputError from validate(): coincident centres, particles outside the box and so on.
Tessellation tessellate(const Specimen& specimen);

/// Builds the tessellation with weights of the voids for which the cell of each void has the volume of the void's
/// sphere, to 0.1 %. With the weight R² the cell of a void is usually larger than its sphere, because it has few
/// facets. The planes between two particles do not change, because the weights of particles stay R².
///
/// Cells keep the volumes that they have reached if the next correction of the weights would leave a particle or void
/// without a cell. Builds the diagram once per correction, usually four to nine times.
///
/// \throws InputError from validate(): coincident centres, particles outside the box and so on.
Tessellation tessellate_with_void_volumes(const Specimen& specimen);

/// Returns one sentence for each of the following faults; returns none for a packing that fills its box.
/// - The spheres fill less than a tenth of the box (see sparse_box()). In this case the faults below are not checked.
/// - A cell reaches far beyond its sphere: more than 4 radii of the largest sphere among the particle and its
///   neighbours, and more than 2 mean spacings (box volume per sphere)^(1/3). The sentence names the facet.
/// - The spheres fill more than 150 % of the box. A sphere of an aggregate of several spheres counts for at most its
///   cell, because such spheres overlap.
std::vector<std::string> packing_warnings(const Specimen& specimen, const Tessellation& tessellation);

/// How far a tessellation violates the laws of every Laguerre diagram. All values would be 0 in exact arithmetic.
struct TessellationInvariants {
  double volume = 0;    ///< |Σ cell volumes − volume of the domain| / volume of the domain
  double closure = 0;   ///< max over cells of |Σ A·n outwards| / Σ A
  double flatness = 0;  ///< max over facets of a vertex's distance to the facet's plane / distance of the centres
  double power = 0;     ///< max over facets and vertices of |pow_a − pow_b| / distance², interior facets
  double walls = 0;     ///< max over walls of |Σ areas of its facets − area of the wall| / area of the wall
};

/// Measures the invariants (used by tests and by `macadam specimen`).
TessellationInvariants measure_invariants(const Specimen& specimen, const Tessellation& tessellation);

}  // namespace macadam
