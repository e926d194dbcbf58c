// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_readers.hpp  One reader a format. They believe nothing: every word must be what its place asks for,
/// and no count is taken that the bytes of the file could not hold.
#pragma once

#include <array>
#include <cstdint>
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

/// What a file holds, before anything is known of it as a whole.
struct SurfaceSoup {
  std::vector<Vec3d> points;                        ///< finite
  std::vector<std::array<std::int64_t, 3>> facets;  ///< numbers of points, from 0, of which there may be none
  std::vector<int> line;                            ///< of each facet; empty where the file has none
};

/// \throws InputError naming file and, of text, line.
/// @{
SurfaceSoup read_stl(const SurfaceFile& file);
SurfaceSoup read_off(const SurfaceFile& file);
SurfaceSoup read_obj(const SurfaceFile& file);
SurfaceSoup read_ply(const SurfaceFile& file);
/// @}

}  // namespace macadam
