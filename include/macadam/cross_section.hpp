// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cross_section.hpp  Computes cross-sections of a specimen: its Laguerre cells, cut exactly by a plane
/// perpendicular to an axis.
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

/// Reads "x=0.025" (metres) or "x=25 mm".
///
/// \throws InputError for another axis, for a text that is not a length, or for a plane outside the bounding box.
SectionPlane read_section_plane(const std::string& text, const Domain& domain);

/// The part of a plane that lies in one cell.
struct SectionCell {
  std::int32_t particle = 0;
  double area = 0;                                 ///< [m²]
  std::uint32_t vertex_begin = 0, vertex_end = 0;  ///< range in CrossSection::vertices
};

/// Convex polygons that fill the cross-section of the domain without gaps or overlaps.
struct CrossSection {
  SectionPlane plane;
  std::vector<SectionCell> cells;  ///< in order of particles; only cells whose section has an area
  /// [m], in the plane; the vertices of a cell are consecutive, counter-clockwise about the axis.
  std::vector<Vec3d> vertices;

  /// Returns the vertices of a cell's polygon.
  std::span<const Vec3d> polygon(const SectionCell& c) const {
    return {vertices.data() + c.vertex_begin, c.vertex_end - c.vertex_begin};
  }
};

/// Cuts the domain by a plane. The section of a particle's cell is the section of the domain, clipped by the planes of
/// equal power (weights R²) between the particle and its neighbours in the tessellation. If a facet lies in the plane,
/// the section of the cell above this facet is used.
///
/// \throws InputError for a plane outside the bounding box.
CrossSection cut(const Specimen& specimen, const Tessellation& tessellation, const SectionPlane& plane);

/// Returns the file name that `macadam specimen` gives a section, such as section_x_0.025.csv.
std::string section_file_name(const SectionPlane& plane);

/// Writes `particle,phase,body,x,y,z`, one row per vertex, polygon after polygon.
/// \throws RunError when the file cannot be written.
void write_cross_section_csv(const std::filesystem::path& file, const Specimen& specimen, const CrossSection& section);

}  // namespace macadam
