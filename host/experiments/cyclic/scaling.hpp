// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scaling.hpp  Computes how much the density may be scaled in a stepped run, from one harmonic solution at true
/// mass.
#pragma once

#include "macadam/harmonic.hpp"

namespace macadam {

/// Returns the largest density scaling, at least 1, whose inertia, together with viscous damping β [1/s], changes E* by
/// no more than `wanted` (|E*| relative, φ in radians). The function uses the derivative of E* at true mass, which is
/// accurate as long as the change is small. `known`: the solution with density scaling 1 and without damping.
double largest_scaling(const HarmonicResult& known, double viscous, double wanted);

}  // namespace macadam
