// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_spectrum.hpp  Largest frequency and static modulus of a network, by textbook linear algebra.
#pragma once

#include <array>
#include <optional>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// ω_max of M⁻¹K [rad/s], rotations included: instantaneous stiffnesses, geometry of the start, walls at rest. The
/// leapfrog is stable for Δt < 2/ω_max. Dense, 6N × 6N: for networks of some hundred particles.
double reference_largest_frequency(const ContactNetwork& network, const LawTable& laws, const Inertia& inertia);

/// Stress at the top wall per strain [Pa] when the top wall is displaced and everything else is in static equilibrium,
/// with instantaneous stiffnesses (for an elastic network, its modulus). Motions without stiffness, such as the
/// sliding and turning of the whole specimen between frictionless walls, are left at rest and held by no force.
/// \throws RunError when no equilibrium is found.
double reference_static_modulus(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws);

}  // namespace macadam
