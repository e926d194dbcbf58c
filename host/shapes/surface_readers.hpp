// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_readers.hpp  One reader a format. They believe nothing: every word must be what its place asks for,
/// and no count is taken that the bytes of the file could not hold.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "macadam/error.hpp"
#include "macadam/numeric.hpp"

namespace macadam {

/// A file's bytes with its name, which every message needs.
struct SurfaceFile {
  std::string name;
  std::string_view bytes;

  /// Line 0: no line applies.
  [[noreturn]] void fail(int line, const std::string& what, const std::string& found,
                         const std::string& expected) const {
    throw InputError(name, line, what, found, expected);
  }
};

/// Points and facets of a file, before they are checked as a whole. A facet is a polygon of three corners or more.
struct SurfaceSoup {
  std::vector<Vec3d> points;          ///< finite
  std::vector<std::int64_t> corners;  ///< numbers of points, from 0, facet after facet; they may be out of range
  std::vector<std::size_t> ends;      ///< of each facet: one past its last corner in `corners`
  std::vector<int> line;              ///< of each facet; empty where the file has none
  std::int64_t first_number = 0;      ///< the file's number of point 0
  std::string note;                   ///< names contents of the file that were left out; empty if there are none

  std::size_t facets() const { return ends.size(); }
  /// The corners of facet f.
  std::span<const std::int64_t> facet(std::size_t f) const {
    const std::size_t begin = f == 0 ? 0 : ends[f - 1];
    return std::span(corners).subspan(begin, ends[f] - begin);
  }
  /// Number of triangles that the facets are cut into.
  std::size_t triangles() const { return corners.size() - 2 * ends.size(); }
  /// Ends a facet whose corners are the last ones of `corners`.
  void end_facet() { ends.push_back(corners.size()); }
};

/// A facet's name in messages.
inline std::string facet_name(std::size_t facet) { return "facet " + std::to_string(facet); }

/// \throws InputError naming file and, of text, line.
/// @{
SurfaceSoup read_stl(const SurfaceFile& file);
SurfaceSoup read_off(const SurfaceFile& file);
SurfaceSoup read_obj(const SurfaceFile& file);
SurfaceSoup read_ply(const SurfaceFile& file);
/// @}

}  // namespace macadam
