// SPDX-License-Identifier: GPL-3.0-or-later
/// \file block_step.hpp  Takes one step within a block of steps, for one displacement component of a contact, by
/// equation (6.8) of the model. During a block, a contact stores only the change of its force. The CPU (cpu_group.hpp)
/// and the tiles of a GPU (tile_step.hpp) share this code.
#pragma once

#include "macadam/laws/law.hpp"
#include "macadam/numeric.hpp"

namespace macadam::kernels {

/// Coefficients of a step; they are the same in every step of a block. See law.block() and block_length.hpp.
template <class T>
struct BlockCoefficients {
  T rate, relax, follow;  ///< rate is multiplied by Δt
};

/// Advances one displacement component by one step with the relative rate u. `change` is δf, the change of the force
/// density f since the beginning of the block. `sum` is the sum, over the steps so far, of δf before the step and δf
/// after it. `drift` is the effect of the states at the beginning of the block. `factor` is 1/(1 + r·k) if rock is in
/// series with the law (model (6.12)).
template <class T, class Factor = laws::NoFactor>
MACADAM_HD void step_in_block_by(const BlockCoefficients<T>& by, const T& u, const T& drift, T& change, T& sum,
                                 const Factor& factor = {}) {
  const T before = change;
  change = before + factor * (by.rate * u + (drift + by.follow * sum - by.relax * before));
  sum = sum + (change + before);
}

}  // namespace macadam::kernels
