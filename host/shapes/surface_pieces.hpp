// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_pieces.hpp  Connected parts of a surface, and which of them lie inside another.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// The connected parts of a surface: facets that share a point are in the same one. Numbered by their first facets.
class SurfacePieces {
 public:
  /// Keeps a reference to the surface, whose numbers must be sound.
  explicit SurfacePieces(const Surface& surface);

  std::int32_t count() const { return count_; }

  /// Area of each piece [m²].
  std::vector<double> areas() const;

  /// For each piece whether it lies inside the piece of the largest volume: a closed pore, or what such a pore holds.
  /// `verdict` has the faults of the surface, all but `pieces` and `inner`. A piece that is open or cuts another one
  /// lies nowhere, and nothing lies inside a faulty one.
  std::vector<bool> find_inner(const SurfaceVerdict& verdict) const;

  /// The surface without the pieces that are marked.
  Surface without(const std::vector<bool>& dropped) const;

 private:
  const Surface& surface_;
  std::vector<std::int32_t> piece_of_;  // of each facet
  std::int32_t count_ = 0;
};

}  // namespace macadam
