// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_pieces.hpp  Finds the connected pieces of a surface, and which of them lie inside another piece.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// The connected pieces of a surface. Facets that share a point belong to the same piece. Pieces are numbered in the
/// order of their first facets.
class SurfacePieces {
 public:
  /// Keeps a reference to the surface, which must have passed require_sound_numbers().
  explicit SurfacePieces(const Surface& surface);

  /// Returns the number of pieces.
  std::int32_t count() const { return count_; }

  /// Returns the area of each piece [m²].
  std::vector<double> areas() const;

  /// Returns for each piece whether it lies inside the piece with the largest volume, either as a closed pore or inside
  /// a closed pore. `verdict` must have all faults of the surface except `pieces` and `inner`. A faulty piece (open or
  /// intersecting another one, for example) does not count as inside; if the largest piece is faulty, no piece counts
  /// as inside.
  std::vector<bool> find_inner(const SurfaceVerdict& verdict) const;

  /// Returns the surface without the marked pieces.
  Surface without(const std::vector<bool>& dropped) const;

 private:
  const Surface& surface_;
  std::vector<std::int32_t> piece_of_;  // piece number of each facet
  std::int32_t count_ = 0;
};

}  // namespace macadam
