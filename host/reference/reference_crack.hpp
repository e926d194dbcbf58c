// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_crack.hpp  Defines the reference implementation of a cohesive crack in series with a contact law.
#pragma once

#include <string>

#include "host/reference/reference_law.hpp"
#include "macadam/laws/crack.hpp"

namespace macadam::reference {

/// Adds a crack to a chain: returns a law whose contact points keep five more numbers before the chain's units: w_n and
/// the two components of w_s (in `stretch[0]` of the three components), y, the work of friction per area, and the
/// energy per area that damage has dissipated (in `stretch[1]`).
/// \throws InputError naming the pair and the parameter, if a parameter is out of range.
ReferenceLaw with_crack(const ReferenceLaw& chain, const laws::Crack& crack, const std::string& pair);

/// Returns the cohesive stress t at the effective opening y [Pa].
double cohesive_stress(const laws::Crack& crack, double y);

/// Returns the work per area ∫₀^y t dy [J/m²].
double cohesive_work(const laws::Crack& crack, double y);

}  // namespace macadam::reference
