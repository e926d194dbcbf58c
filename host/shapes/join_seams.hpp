// SPDX-License-Identifier: GPL-3.0-or-later
/// \file join_seams.hpp  Facets that share a corner only to rounding are joined there.
#pragma once

#include <cstdint>

#include "macadam/shape.hpp"

namespace macadam {

/// Counts of the changes that join_seams() made.
struct SeamJoin {
  std::int64_t points = 0;  ///< joined with another one
  std::int64_t facets = 0;  ///< dropped, as two of their corners were joined
};

/// Distance below which two points at open edges are one [m]: rounding of single precision, of a surface of this size.
double seam_width(const Surface& surface);

/// Joins points at open edges that are closer than seam_width(), each with the first such point. Other points are never
/// joined, so that a closed surface is not changed, however fine it is. No point moves by more than that width.
/// Equal points must have been joined before.
SeamJoin join_seams(Surface& surface);

}  // namespace macadam
