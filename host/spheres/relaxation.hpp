// SPDX-License-Identifier: GPL-3.0-or-later
/// \file relaxation.hpp  Spreads overlapping mastic evenly between the aggregates.
#pragma once

#include <functional>

#include "macadam/specimen.hpp"

namespace macadam {

/// How deep a point lies below a wall [m], negative beyond it, and the unit vector away from the wall.
struct WallDepth {
  double depth;
  Vec3d inward;
};

/// A wall of any shape.
struct Enclosure {
  /// Tells how deep a point lies; where that is more than `reach` [m], any depth above `reach` will do.
  std::function<WallDepth(const Vec3d& point, double reach)> depth;
  double stiffness = 10;  ///< over that of a pair, at most 10; what the wall holds may press hard against it
};

/// Moves the mastic (and the aggregates, unless held) downhill in the energy ½·k·overlap² of all pairs and walls until
/// the energy has stalled. The walls are the box and, if its depth is given, `wall`. Aggregates stand before the
/// mastic in `specimen`. The same input gives the same bits for any number of threads. Returns the iterations taken.
int relax(Specimen& specimen, bool fix_aggregates, const std::function<void(double share)>& progress,
          const Enclosure& wall = {});

/// Largest overlap of two aggregates [m], 0 if there is none.
double largest_aggregate_overlap(const Specimen& specimen);

}  // namespace macadam
