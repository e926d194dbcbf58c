// SPDX-License-Identifier: GPL-3.0-or-later
/// \file make_system.hpp  Builds the arrays of the iterative solver from a network.
#pragma once

#include "host/harmonic/rigid_motions.hpp"
#include "kernels/harmonic/linear_system.hpp"
#include "kernels/layout/layout.hpp"
#include "macadam/specimen.hpp"

namespace macadam::harmonic {

/// Returns the linear system in the order of the layout: the contacts of each particle, the free motions, and the
/// coarse level of the preconditioner. The coarse level consists of the rigid motions of the layout's tiles (boxes of
/// particles).
/// \throws NotIterable when boxes of particles can move without force.
kernels::LinearSystem make_system(const ContactNetwork& network, const Specimen& specimen,
                                  const kernels::Layout& layout, const PairStiffness& typical, const Inertia& inertia,
                                  const FreeMotions& free);

/// Returns K_ii⁻¹ of every particle, [body][36]: the fine level of the preconditioner.
/// \throws NotIterable naming a particle that has a motion which no contact resists.
std::vector<double> invert_particle_blocks(const kernels::LinearSystem& system, const kernels::Layout& layout);

/// Throws NotIterable naming a particle that has a motion which no contact resists. `body` is the number of this
/// particle in the layout.
[[noreturn]] void refuse_loose_particle(std::int64_t body, const kernels::Layout& layout);

}  // namespace macadam::harmonic
