// SPDX-License-Identifier: GPL-3.0-or-later
/// \file harmonic_code.hpp  Declares the functions of the frequency domain whose speed depends on the SIMD registers of
/// the processor. They are compiled once for each processor generation, and at run time the newest generation that the
/// processor supports is chosen.
#pragma once

#include <functional>
#include <vector>

#include "host/harmonic/check_solutions.hpp"
#include "host/harmonic/linear_solver.hpp"
#include "kernels/harmonic/linear_system.hpp"
#include "kernels/layout/layout.hpp"

namespace macadam::harmonic {

/// Functions of the frequency domain compiled for one processor generation.
struct HarmonicCode {
  /// Solves tasks by iteration; see solve_block() in iterative/block_cocg.hpp.
  void (*solve_block)(const kernels::LinearSystem& system, const std::vector<double>& inverse,
                      const kernels::Layout& layout, std::vector<LinearTask*> tasks, const std::function<bool()>& stop);
  /// Checks solutions; see check_solutions() in check_solutions.hpp.
  std::vector<SolutionCheck> (*check_solutions)(const ContactNetwork& network, const Inertia& inertia,
                                                const std::vector<const LinearTask*>& tasks, double rounding);
};

/// Returns the functions for the processor generation that processor_generation() chooses.
const HarmonicCode& harmonic_code();

}  // namespace macadam::harmonic
