// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_packing.hpp  Packs bodies by growing them to full size while overlaps push them apart.
#pragma once

#include <functional>
#include <vector>

#include "host/specimen/packing/shape_body.hpp"

namespace macadam {

/// Grows `bodies` to full size. At the start they are in the box without overlap, at the fraction `from` of their
/// sizes. At the end no two of them touch, by exact tests. Returns the scale that was reached: 1, or less if the bodies
/// jammed. Jammed bodies may overlap. `gap` is the distance that two surfaces, or a surface and a wall, should keep,
/// relative to the smaller body's D^I; no two surfaces come closer than about half of this distance. The same input
/// gives the same bits for any number of threads.
double pack(const Domain& box, std::vector<ShapeBody>& bodies, double from, double gap,
            const std::function<void(double share)>& progress);

}  // namespace macadam
