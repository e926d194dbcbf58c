// SPDX-License-Identifier: GPL-3.0-or-later
/// \file library_targets.hpp  What each shape of the library is to be: drawn so that Tables 1 and 2 come out.
#pragma once

#include <vector>

#include "host/spheres/random_stream.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// One measure a shape, from the smallest to the largest D^I. Set are points, facets, D^L, D^I, D^S, ψ^w
/// and, roughly, V; what else a measure derives from these (SI, F, Fl, E, ψ^A) then has the statistics of [1].
///
/// D^I, E, F, ψ^w and the number of points are strata of distributions that have the ranges of [1], its averages, sieve
/// classes and classes of elongation and flatness. Which of E, F and points meet which D^I is decided by exchanging
/// values between two shapes as long as that brings what follows nearer to the rest of Table 1 and to Table 2; ψ^w then
/// goes with ψ^A. `shapes` is one or more.
std::vector<ShapeMeasure> draw_library_targets(RandomStream& random, int shapes);

}  // namespace macadam
