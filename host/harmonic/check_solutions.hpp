// SPDX-License-Identifier: GPL-3.0-or-later
/// \file check_solutions.hpp  Checks solutions of the linear systems: computes residuals and the parts of E* from the
/// network itself, for up to four solutions in one pass over the contacts.
#pragma once

#include <vector>

#include "host/harmonic/linear_solver.hpp"

namespace macadam::harmonic {

/// Results of the check of a solution u, in which the top wall moves by one.
struct SolutionCheck {
  double residual = 0;         ///< ‖f − (K* − inertia·M)·u‖ [N]
  double beyond_rounding = 0;  ///< the residual without the parts that rounding explains [N]
  Complex inertia = 0;         ///< uᵀ·M·u [kg]
  /// Sums of u·k*·u over the contacts of each pair, with their relative displacements u and without conjugates; for a
  /// real stiffness this is twice the energy. The sums are not yet divided by the specimen's size and do not contain
  /// inertia.
  ModulusParts parts;
};

/// Checks the motions of tasks, four in one pass. The numbers of a motion have rounding errors, which the stiffness of
/// stiff contacts turns into errors of the loads. If the load is much smaller than these errors, no smaller residual
/// can be expected. A residual is attributed to rounding if it is at most the fraction `rounding` of the load that the
/// particle would have if nothing cancelled. With 0 no residual is attributed to rounding. Sums are computed per piece
/// of particles, then added in order, so that the result does not depend on the number of threads.
std::vector<SolutionCheck> check_solutions(const ContactNetwork& network, const Inertia& inertia,
                                           const std::vector<const LinearTask*>& tasks, double rounding);

}  // namespace macadam::harmonic
