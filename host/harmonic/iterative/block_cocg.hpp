// SPDX-License-Identifier: GPL-3.0-or-later
/// \file block_cocg.hpp  Solves by conjugate gradients for complex symmetric matrices (COCG), for several linear
/// systems side by side.
#pragma once

#include <vector>

#include "host/harmonic/linear_solver.hpp"
#include "kernels/harmonic/linear_system.hpp"
#include "kernels/layout/layout.hpp"

namespace macadam::harmonic {

/// Solves up to four tasks at once and stores the results in them. `inverse` is the result of invert_particle_blocks().
/// \throws InterruptedError when `stop` is given and returns true.
void solve_block(const kernels::LinearSystem& system, const std::vector<double>& inverse, const kernels::Layout& layout,
                 std::vector<LinearTask*> tasks, const std::function<bool()>& stop);

}  // namespace macadam::harmonic
