// SPDX-License-Identifier: GPL-3.0-or-later
/// \file check_solutions.hpp  Checks solutions of the linear systems: computes residuals and the parts of E* from the
/// network itself, for up to four solutions in one pass over the contacts.
#pragma once

#include <vector>

#include "host/harmonic/linear_solver.hpp"

namespace macadam::harmonic {

/// Results of the check of a solution u, in which the top wall moves by one unit (LinearTask::wall).
struct SolutionCheck {
  double residual = 0;         ///< ‖f − (K* − inertia·M)·u‖ [N]
  double beyond_rounding = 0;  ///< the residual without the parts that rounding explains [N]
  Complex inertia = 0;         ///< uᵀ·M·u [kg]
  /// Sums of w·k*·w over the contacts of each pair type, where w is the relative displacement of a contact; no factor
  /// is conjugated. For a real stiffness this sum is twice the energy. The sums are not yet multiplied by height over
  /// cross-section, and they do not contain inertia.
  ModulusParts parts;
};

/// Checks the solutions of tasks, four in one pass over the contacts. The numbers of a solution have rounding errors.
/// Stiff contacts turn these into errors of the loads. If the load is much smaller than these errors, no smaller
/// residual can be expected. The residual of a particle is attributed to rounding if it is at most the fraction
/// `rounding` of the load that the particle would have if no terms of the sum cancelled. With `rounding` 0 no residual
/// is attributed to rounding. Sums are computed for pieces of some particles each, then added in order, so that the
/// result does not depend on the number of threads.
std::vector<SolutionCheck> check_solutions(const ContactNetwork& network, const Inertia& inertia,
                                           const std::vector<const LinearTask*>& tasks, double rounding);

}  // namespace macadam::harmonic
