// SPDX-License-Identifier: GPL-3.0-or-later
/// \file phase_derivatives.hpp  Computes the derivatives of E* with respect to the stiffness of the mastic and to the
/// Poisson's ratios of both phases (model, section 16).
#pragma once

#include "host/harmonic/contact_operator.hpp"

namespace macadam::harmonic {

/// Sets `pressure_of_mastic`, `mastic_poisson_ratio` and `rock_poisson_ratio` of `parts`. The other members of `parts`
/// must be those of the solution `motion`, whose top wall moves by one, and not yet multiplied by height over
/// cross-section; so are the new ones. `pressures` is the result of cell_pressures() for this solution. Changes nothing
/// for networks with the rule "centres".
void add_phase_derivatives(const ContactNetwork& network, const PairStiffness& stiffness, const Vector& motion,
                           const Vector& pressures, ModulusParts& parts);

}  // namespace macadam::harmonic
