// SPDX-License-Identifier: GPL-3.0-or-later
/// \file relaxation.hpp  Spreads overlapping mastic evenly between the aggregates.
#pragma once

#include <functional>

#include "macadam/specimen.hpp"

namespace macadam {

/// Moves the mastic (and the aggregates, unless held) downhill in the energy ½·k·overlap² of all pairs and walls until
/// the energy has stalled. Aggregates stand before the mastic in `specimen`. The same input gives the same bits for
/// any number of threads. Returns the iterations taken.
int relax(Specimen& specimen, bool fix_aggregates, const std::function<void(double share)>& progress);

/// Largest overlap of two aggregates [m], 0 if there is none.
double largest_aggregate_overlap(const Specimen& specimen);

}  // namespace macadam
