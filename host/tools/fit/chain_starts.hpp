// SPDX-License-Identifier: GPL-3.0-or-later
/// \file chain_starts.hpp  Computes starting values for the refinement of a Kelvin chain.
#pragma once

#include <vector>

#include "host/tools/fit/chain_fit.hpp"

namespace macadam::fitting {

/// Returns θ of several starts. For given retardation times the compliance is linear in 1/E_m, 1/C_m and 1/E_l, and
/// non-negative least squares find these. Three kinds of retardation times are used: the times of logarithmic grids,
/// merged until one time per unit is left; times that are equally spaced in the logarithm; and the times of each chain
/// in `known` that is not longer than this chain, with the missing times added. `shift`: unknowns of the shift, for the
/// starts that do not come from a known chain.
std::vector<std::vector<double>> chain_starts(const Unknowns& unknowns, const std::vector<Target>& targets,
                                              const std::vector<double>& shift, const std::vector<const Chain*>& known);

}  // namespace macadam::fitting
