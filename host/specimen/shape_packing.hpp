// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_packing.hpp  Bodies grown to their size while overlaps push them apart.
#pragma once

#include <functional>
#include <vector>

#include "host/specimen/shape_body.hpp"

namespace macadam {

/// Grows `bodies`, which stand in the box without overlap at the scale `from` of their sizes, to full size; in the end
/// no two of them touch, by exact tests. Returns the scale that was reached: 1, or less where they jammed on the way,
/// and then nothing is promised of their places. `gap`, over the smaller body's D^I, is asked to stay between two
/// surfaces, or one and a wall; none come nearer than about half of it.
/// The same input gives the same bits for any number of threads.
double pack(const Box& box, std::vector<ShapeBody>& bodies, double from, double gap,
            const std::function<void(double share)>& progress);

}  // namespace macadam
