// SPDX-License-Identifier: GPL-3.0-or-later
/// \file chain_fit.hpp  A generalised Kelvin chain of so many units through given moduli.
#pragma once

#include <vector>

#include "host/fit/least_squares.hpp"

namespace macadam::fitting {

/// Limits of sense for the unknowns of a chain: springs and times by several decades around those of the targets.
/// `shift`: unknowns of the shift to begin with.
std::vector<Limits> chain_limits(const Unknowns& unknowns, const std::vector<Target>& targets,
                                 const std::vector<double>& shift);

/// A chain that was found, and what its unknowns are.
struct Chain {
  Unknowns unknowns;
  Minimum minimum;
};

/// Whether every curve of the smaller chain is one of the larger chain too.
bool contains(const Unknowns& larger, const Unknowns& smaller);

/// The chain of `unknowns.units` units with the least misfit that chain_starts() lead to. The misfit is at most that of
/// each chain in `known` that this one contains. An element without effect then lies at its limit, where a spring still
/// changes |E*| by at most e^-12 of it.
/// `limits`: of all unknowns, shift included. `shift`: unknowns of the shift to begin with. `tolerance`: relative
/// change of the misfit in a step at which the refinement ends. \throws RunError if no start has a finite misfit.
Minimum fit_chain(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
                  const std::vector<double>& shift, const std::vector<const Chain*>& known,
                  double tolerance = to_rounding);

/// The law that θ stands for, α = 0.
laws::GeneralisedKelvin chain_of(const Unknowns& unknowns, const std::vector<double>& theta);

}  // namespace macadam::fitting
