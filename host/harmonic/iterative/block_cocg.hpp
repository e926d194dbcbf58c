// SPDX-License-Identifier: GPL-3.0-or-later
/// \file block_cocg.hpp  Conjugate gradients for complex symmetric matrices (COCG), several frequencies side by side.
#pragma once

#include <vector>

#include "host/harmonic/iterative/contact_rows.hpp"
#include "host/harmonic/iterative/two_level.hpp"
#include "host/harmonic/linear_solver.hpp"

namespace macadam::harmonic {

/// Free motions of the whole that it can keep out: of two specimens side by side in a box.
inline constexpr std::size_t most_free_motions = 6;

/// Solves up to four tasks at once.
void solve_block(const ContactRows& rows, const TwoLevel& preconditioner, const kernels::Layout& layout,
                 const Inertia& inertia, const FreeMotions& free, std::vector<LinearTask*> tasks);

}  // namespace macadam::harmonic
