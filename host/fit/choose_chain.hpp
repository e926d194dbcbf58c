// SPDX-License-Identifier: GPL-3.0-or-later
/// \file choose_chain.hpp  Chains of every length, with and without a dashpot, and the one that the criterion takes.
#pragma once

#include "host/fit/chain_fit.hpp"
#include "host/fit/problem.hpp"

namespace macadam::fitting {

/// Fits the chains that the options of `fit` ask for and adds them to `fit.candidates`. A chain starts from those that
/// it contains, so its misfit is not above theirs. Returns the one with the least criterion among those whose
/// parameters are all determined, or among all where there is none; its number goes into `fit.chosen`. \throws
/// InputError where the measurements are fewer than the parameters of the smallest chain.
Chain choose_chain(const Problem& problem, const ModulusData& data, Fit& fit);

}  // namespace macadam::fitting
