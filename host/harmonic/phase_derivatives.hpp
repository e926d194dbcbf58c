// SPDX-License-Identifier: GPL-3.0-or-later
/// \file phase_derivatives.hpp  Computes the derivatives of E* with respect to the stiffness of the mastic and to the
/// Poisson's ratios of both phases (model, section 16).
#pragma once

#include "host/harmonic/contact_operator.hpp"

namespace macadam::harmonic {

/// Sets `pressure_of_mastic`, `mastic_poisson_ratio` and `rock_poisson_ratio` of `parts`. `parts` must contain the
/// other parts of the solution `motion`, in which the walls move by `wall`. All parts are in the unit of uᵀ·K·u,
/// before they are multiplied by height over cross-section. `pressures` is the result of cell_pressures() for this
/// solution. Changes nothing for networks with the rule "centres".
void add_phase_derivatives(const ContactNetwork& network, const PairStiffness& stiffness, const Vector& motion,
                           const WallMotion& wall, const Vector& pressures, ModulusParts& parts);

}  // namespace macadam::harmonic
