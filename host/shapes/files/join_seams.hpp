// SPDX-License-Identifier: GPL-3.0-or-later
/// \file join_seams.hpp  Joins points at open edges of a surface if the points differ by rounding only. An open
/// edge belongs to an odd number of facets.
#pragma once

#include <cstdint>

#include "macadam/shape.hpp"

namespace macadam {

/// Counts of the changes that join_seams() made.
struct SeamJoin {
  std::int64_t points = 0;  ///< number of points joined with another point
  std::int64_t facets = 0;  ///< number of facets dropped because two of their corners were joined
};

/// Returns the distance below which two points at open edges count as one [m]: the single-precision rounding for a
/// surface of this size.
double seam_width(const Surface& surface);

/// Joins points at open edges that lie within seam_width() of each other. Each point is replaced by the lowest-numbered
/// point at an open edge within this distance that has not been replaced itself. Other points are never joined, so that
/// a closed surface is not changed, however fine it is. No point moves by more than seam_width(). join_equal_points()
/// must have been called before.
SeamJoin join_seams(Surface& surface);

}  // namespace macadam
