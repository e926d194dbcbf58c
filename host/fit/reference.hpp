// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference.hpp  A fitted model at another reference temperature.
#pragma once

#include "host/fit/chain_fit.hpp"
#include "host/fit/problem.hpp"

namespace macadam::fitting {

/// Moves a model from the reference temperature at which it was fitted to the one that was asked for. The curves stay:
/// viscosities or τ are multiplied by a_T, and the shift law is written for the new temperature.
/// \throws InputError where the shift law has no value at that temperature.
void move_reference(const Problem& problem, const ModulusData& data, Chain& fitted);

}  // namespace macadam::fitting
