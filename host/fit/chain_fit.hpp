// SPDX-License-Identifier: GPL-3.0-or-later
/// \file chain_fit.hpp  A generalised Kelvin chain of so many units through given moduli.
#pragma once

#include <optional>
#include <vector>

#include "host/fit/least_squares.hpp"

namespace macadam::fitting {

/// Limits of sense for the unknowns of a chain: springs and times by several decades around those of the targets.
std::vector<Limits> chain_limits(const Unknowns& unknowns, const std::vector<Target>& targets);

/// The chain of `unknowns.units` units with the least misfit. Starts are linear: for given retardation times the
/// compliance is linear in 1/E_m, 1/C_m and 1/E_l, which non-negative least squares find. The times are those of a fine
/// logarithmic grid, merged into so many; equally spaced ones; and those of the chain with one unit less, `fewer`, with
/// the best one of the grid added. `shift`: the unknowns of the shift to begin with.
/// `limits` are those of all unknowns, shift included.
Minimum fit_chain(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
                  const std::vector<double>& shift, const Minimum* fewer, double tolerance = to_rounding);

/// The law that θ stands for, α = 0.
laws::GeneralisedKelvin chain_of(const Unknowns& unknowns, const std::vector<double>& theta);

}  // namespace macadam::fitting
