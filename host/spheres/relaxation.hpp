// SPDX-License-Identifier: GPL-3.0-or-later
/// \file relaxation.hpp  Spreads overlapping mastic spheres evenly between the aggregates by minimising an overlap
/// energy.
#pragma once

#include <functional>

#include "macadam/specimen.hpp"

namespace macadam {

/// Depth of a point below a wall [m], negative outside, and the unit vector pointing away from the wall.
struct WallDepth {
  double depth;
  Vec3d inward;
};

/// A wall of any shape, given by its depth function.
struct Enclosure {
  /// Returns the depth of a point; if the depth is more than `reach` [m], any value above `reach` may be returned.
  std::function<WallDepth(const Vec3d& point, double reach)> depth;
  /// Stiffness of the wall, divided by the stiffness of a pair of mastic spheres, at most 10. The wall is stiffer than
  /// the spheres because they may be pressed hard against it.
  double stiffness = 10;
};

/// Minimises the energy ½·k·overlap² of all pairs and walls (model (21.1)) by moving the mastic, and the aggregates too
/// unless they are fixed, until the energy has stalled. The walls are the walls of the box and, if its depth function
/// is set, `wall`. In `specimen` all aggregates must precede the mastic. The same input gives the same bits for any
/// number of threads. Returns the number of iterations.
int relax(Specimen& specimen, bool fix_aggregates, const std::function<void(double share)>& progress,
          const Enclosure& wall = {});

/// Returns the largest overlap of two aggregates [m], or 0 if none overlap.
double largest_aggregate_overlap(const Specimen& specimen);

}  // namespace macadam
