// SPDX-License-Identifier: GPL-3.0-or-later
/// \file choose_chain.hpp  Fits chains of every length, with and without a dashpot, and chooses one by the criterion.
#pragma once

#include "host/tools/fit/chain_fit.hpp"
#include "host/tools/fit/problem.hpp"

namespace macadam::fitting {

/// Fits the chains that the options of `fit` request, and adds them to `fit.candidates`. A chain also starts from the
/// smaller chains that it contains, so its misfit is at most as large as the misfits of the smaller chains. Returns the
/// chain with the smallest criterion among those without a parameter at its limits, or among all chains if each has
/// one; its number is stored in `fit.chosen`. \throws InputError when there are fewer measured numbers than the
/// smallest chain needs.
Chain choose_chain(const Problem& problem, const ModulusData& data, Fit& fit);

}  // namespace macadam::fitting
