// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cross_section.hpp  The Laguerre cells of a specimen, cut exactly by a plane across the box.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "macadam/tessellation.hpp"

namespace macadam {

/// A plane x = position, y = position or z = position.
struct SectionPlane {
  char axis = 'x';      ///< 'x', 'y' or 'z'
  double position = 0;  ///< [m]
};

/// Reads `"x=0.025"` (metres) or `"x=25 mm"`.
/// \throws InputError for another axis, for what is no length, or for a plane outside the box.
SectionPlane read_section_plane(const std::string& text, const Box& box);

/// What a plane shows of one cell.
struct SectionCell {
  std::int32_t particle = 0;
  double area = 0;                                 ///< [m²]
  std::uint32_t vertex_begin = 0, vertex_end = 0;  ///< range in CrossSection::vertices
};

/// Convex polygons that fill the box's cross-section without gap or overlap.
struct CrossSection {
  SectionPlane plane;
  std::vector<SectionCell> cells;  ///< in order of particles; those that the plane meets in an area
  std::vector<Vec3d> vertices;     ///< [m], in the plane; each cell's own run, counter-clockwise about the axis

  std::span<const Vec3d> polygon(const SectionCell& c) const {
    return {vertices.data() + c.vertex_begin, c.vertex_end - c.vertex_begin};
  }
};

/// Cuts the box by a plane: its rectangle, clipped for each particle by the planes of equal power (weights R²) with the
/// neighbours that the tessellation knows. A plane that contains a facet belongs to the cell above it.
/// \throws InputError for a plane outside the box.
CrossSection cut(const Specimen& specimen, const Tessellation& tessellation, const SectionPlane& plane);

/// `section_x_0.025.csv`: the name that `macadam specimen` gives a section.
std::string section_file_name(const SectionPlane& plane);

/// Writes `particle,phase,body,x,y,z`, a row for each vertex, polygon after polygon.
/// \throws RunError when the file cannot be written.
void write_cross_section_csv(const std::filesystem::path& file, const Specimen& specimen, const CrossSection& section);

}  // namespace macadam
