// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_packing.hpp  Bodies grown to their size while overlaps push them apart.
#pragma once

#include <functional>
#include <vector>

#include "host/specimen/shape_body.hpp"

namespace macadam {

/// Gaps that stay between the surfaces of two bodies, and of a body and a wall.
struct PackingGap {
  double share;  ///< of the smaller body's D^I; no surfaces come nearer than about half of the gap
  double least;  ///< and never asked to be less than this [m]
};

/// Grows `bodies`, which stand in the box without overlap at the scale `from` of their sizes, to full size; in the end
/// no two of them touch, by exact tests. Returns the scale that was reached: 1, or less where they jammed on the way,
/// and then nothing is promised of their places.
/// The same input gives the same bits for any number of threads.
double pack(const Box& box, std::vector<ShapeBody>& bodies, double from, const PackingGap& gap,
            const std::function<void(double share)>& progress);

}  // namespace macadam
