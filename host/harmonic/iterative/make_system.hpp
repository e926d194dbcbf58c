// SPDX-License-Identifier: GPL-3.0-or-later
/// \file make_system.hpp  From a network to the arrays of the iteration.
#pragma once

#include "host/harmonic/rigid_motions.hpp"
#include "kernels/harmonic/linear_system.hpp"
#include "kernels/layout.hpp"
#include "macadam/specimen.hpp"

namespace macadam::harmonic {

/// Rows of contacts, and the coarse level of the preconditioner: the rigid motions of the layout's tiles.
/// \throws NotIterable when boxes of particles can move without force.
kernels::LinearSystem make_system(const ContactNetwork& network, const Specimen& specimen,
                                  const kernels::Layout& layout, const PairStiffness& typical, const Inertia& inertia,
                                  const FreeMotions& free);

/// K_ii⁻¹ of every body, [body][36]: the fine level of the preconditioner.
/// \throws NotIterable naming the particle that can move by itself without force.
std::vector<double> invert_particle_blocks(const kernels::LinearSystem& system, const kernels::Layout& layout);

/// \throws NotIterable saying so; `body`: the first of them.
[[noreturn]] void refuse_loose_particle(std::int64_t body, const kernels::Layout& layout);

}  // namespace macadam::harmonic
