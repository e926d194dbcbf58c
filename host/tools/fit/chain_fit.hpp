// SPDX-License-Identifier: GPL-3.0-or-later
/// \file chain_fit.hpp  Fits a generalised Kelvin chain with a given number of units to moduli.
#pragma once

#include <vector>

#include "host/tools/fit/least_squares.hpp"

namespace macadam::fitting {

/// Returns bounds for the unknowns of a chain: moduli and times several decades beyond the moduli and times of the
/// targets. `shift`: first values of the unknowns of the shift.
std::vector<Limits> chain_limits(const Unknowns& unknowns, const std::vector<Target>& targets,
                                 const std::vector<double>& shift);

/// A fitted chain (or other model), with the meaning of its unknowns.
struct Chain {
  Unknowns unknowns;
  Minimum minimum;
};

/// Returns whether every curve of the smaller chain is also a curve of the larger chain.
bool contains(const Unknowns& larger, const Unknowns& smaller);

/// Returns the chain of `unknowns.units` units with the smallest misfit that is reached from chain_starts(). The misfit
/// is at most as large as the misfit of each chain in `known` that this chain contains. An element that the larger
/// chain does not need then lies at its limit. A spring at its limit changes |E*| by at most a fraction of e^-12.
/// `limits`: limits of all unknowns, including the unknowns of the shift. `shift`: first values of the unknowns of the
/// shift. `tolerance`: relative change of the misfit per step at which the refinement ends. \throws RunError if no
/// start has a finite misfit.
Minimum fit_chain(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
                  const std::vector<double>& shift, const std::vector<const Chain*>& known,
                  double tolerance = to_rounding);

/// Returns the law with the constants θ, with α = 0.
laws::GeneralisedKelvin chain_of(const Unknowns& unknowns, const std::vector<double>& theta);

}  // namespace macadam::fitting
