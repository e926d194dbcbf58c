// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scaling.hpp  How much a mass may be scaled, from one solution at true mass.
#pragma once

#include "macadam/harmonic.hpp"

namespace macadam {

/// The largest density scaling, 1 at least, whose inertia, with viscous damping β [1/s], changes E* by no more than
/// `wanted` (|E*| relative, φ in radians), by the derivative of E* at true mass: it is straight as long as the change
/// is small. `known`: of density scaling 1 without damping.
double largest_scaling(const HarmonicResult& known, double viscous, double wanted);

}  // namespace macadam
