// SPDX-License-Identifier: GPL-3.0-or-later
/// \file library_targets.hpp  Chooses target measures for the shapes of a generated library, such that the statistics
/// of the library are those of Tables 1 and 2 of reference [1] (docs/model.md).
#pragma once

#include <vector>

#include "host/spheres/random_stream.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Returns the target measures of each shape, ordered from the smallest to the largest D^I. Points, facets, D^L, D^I,
/// D^S, ψ^w and, approximately, V are set; the measures that derive from these (SI, F, Fl, E, ψ^A) then have the
/// statistics of [1]. `shapes` must be at least 1.
///
/// The values of D^I, E, F, ψ^w and the number of points are the midpoints of equal strata of distributions with the
/// ranges, averages, sieve classes and classes of elongation and flatness of [1]. The combinations of D^I with E, F and
/// number of points start at random. Values are then exchanged between two shapes as long as this brings the remaining
/// statistics closer to Table 1 and Table 2. Finally ψ^w is assigned in the order of ψ^A.
std::vector<ShapeMeasure> draw_library_targets(RandomStream& random, int shapes);

}  // namespace macadam
