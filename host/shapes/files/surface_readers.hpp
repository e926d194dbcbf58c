// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_readers.hpp  Declares the readers of surface files, one per format. The readers do not trust the
/// file: every word must be valid at its position, and a count of items is accepted only if the file is large enough to
/// hold them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "macadam/error.hpp"
#include "macadam/numeric.hpp"

namespace macadam {

/// The bytes of a file and its name, which every message gives.
struct SurfaceFile {
  std::string name;
  std::string_view bytes;

  /// Always throws an InputError about `line`, which is 0 if no line applies.
  [[noreturn]] void fail(int line, const std::string& what, const std::string& found,
                         const std::string& expected) const {
    throw InputError(name, line, what, found, expected);
  }
};

/// Points and facets as read from a file, before they are checked together. A facet is a polygon with three or more
/// corners.
struct SurfaceSoup {
  std::vector<Vec3d> points;  ///< all coordinates are finite
  /// Point numbers from 0, facet after facet; not yet checked against the number of points.
  std::vector<std::int64_t> corners;
  std::vector<std::size_t> ends;  ///< for each facet: index in `corners` one past its last corner
  std::vector<int> line;          ///< line of each facet; empty for formats without lines
  std::int64_t first_number = 0;  ///< the number that the file gives to point 0
  std::string note;               ///< describes contents of the file that were skipped; otherwise empty

  std::size_t facets() const { return ends.size(); }
  /// Returns the corners of facet f.
  std::span<const std::int64_t> facet(std::size_t f) const {
    const std::size_t begin = f == 0 ? 0 : ends[f - 1];
    return std::span(corners).subspan(begin, ends[f] - begin);
  }
  /// Returns the number of triangles into which the facets will be divided.
  std::size_t triangles() const { return corners.size() - 2 * ends.size(); }
  /// Completes one facet whose corners were appended to `corners`.
  void end_facet() { ends.push_back(corners.size()); }
};

/// Returns the name of a facet in messages.
inline std::string facet_name(std::size_t facet) { return "facet " + std::to_string(facet); }

/// Reads one file of one format. \throws InputError naming the file and, for text, the line.
/// @{
SurfaceSoup read_stl(const SurfaceFile& file);
SurfaceSoup read_off(const SurfaceFile& file);
SurfaceSoup read_obj(const SurfaceFile& file);
SurfaceSoup read_ply(const SurfaceFile& file);
/// @}

}  // namespace macadam
