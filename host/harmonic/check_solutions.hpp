// SPDX-License-Identifier: GPL-3.0-or-later
/// \file check_solutions.hpp  What is left of the loads in solutions, and what their contacts carry, computed anew from
/// the network: of four in one pass over the contacts.
#pragma once

#include <vector>

#include "host/harmonic/linear_solver.hpp"

namespace macadam::harmonic {

/// What a look at a solution u finds, where the top wall moves by one.
struct SolutionCheck {
  double residual = 0;         ///< ‖f − (K* − inertia·M)·u‖ [N]
  double beyond_rounding = 0;  ///< of it [N]
  Complex inertia = 0;         ///< uᵀ·M·u [kg]
  /// Σ u·k*·u over the contacts of each pair, u their relative displacements, without conjugates: twice the energy,
  /// where real. Not yet over the specimen's size, and without inertia.
  ModulusParts parts;
};

/// Checks tasks that have their motions, four in a pass. Motions are known to rounding, and loads of stiff contacts to
/// that of them: where the load is far less, that is all that can be asked. `rounding`: of what a load would be if
/// nothing cancelled, the share that is put down to it; 0: none is. Sums are made piece by piece of particles and then
/// in order: the same bits for any number of threads.
std::vector<SolutionCheck> check_solutions(const ContactNetwork& network, const Inertia& inertia,
                                           const std::vector<const LinearTask*>& tasks, double rounding);

}  // namespace macadam::harmonic
