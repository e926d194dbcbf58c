// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference.hpp  Moves a fitted model to another reference temperature.
#pragma once

#include "host/tools/fit/chain_fit.hpp"
#include "host/tools/fit/problem.hpp"

namespace macadam::fitting {

/// Moves a model from the reference temperature of the fit to the one that the user asked for. The curves do not
/// change: viscosities or τ are multiplied by a_T, and the shift law is rewritten for the new temperature.
/// \throws InputError if the shift law has no value at that temperature.
void move_reference(const Problem& problem, const ModulusData& data, Chain& fitted);

}  // namespace macadam::fitting
