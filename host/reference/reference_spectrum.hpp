// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_spectrum.hpp  Computes the largest eigenfrequency and the static modulus of a network by textbook
/// linear algebra.
#pragma once

#include <array>
#include <optional>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// Returns ω_max of M⁻¹K [rad/s], rotations included, for instantaneous stiffnesses, the initial geometry and walls at
/// rest. Leapfrog is stable for Δt < 2/ω_max. The matrices are dense, 6N × 6N, so the number N of particles may be at
/// most some hundred.
double reference_largest_frequency(const ContactNetwork& network, const LawTable& laws, const Inertia& inertia);

/// Returns the stress at the top wall per strain [Pa] when the top wall is displaced and all particles are in static
/// equilibrium, with instantaneous stiffnesses (for an elastic network, its modulus). Motions without stiffness stay at
/// rest and no force holds them; an example is the sliding and turning of the whole specimen between frictionless
/// walls.
/// \throws RunError when no equilibrium is found.
double reference_static_modulus(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws);

}  // namespace macadam
