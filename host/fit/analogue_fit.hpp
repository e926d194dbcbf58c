// SPDX-License-Identifier: GPL-3.0-or-later
/// \file analogue_fit.hpp  2S2P1D or Huet–Sayegh through given moduli.
#pragma once

#include <vector>

#include "host/fit/least_squares.hpp"

namespace macadam::fitting {

/// Limits of sense for the model's unknowns.
std::vector<Limits> analogue_limits(const Unknowns& unknowns, const std::vector<Target>& targets);

/// The model with the least misfit that the best of many starts reach, k < h. `shift` and `limits` as fit_chain() has
/// them. 2S2P1D starts from the Huet–Sayegh model too, which it contains, and a free shift from `contained`: θ of shift
/// laws, in terms of these unknowns. The misfit is at most theirs.
Minimum fit_analogue(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
                     const std::vector<double>& shift, const std::vector<std::vector<double>>& contained = {});

/// The model that θ stands for.
AnalogueModel analogue_of(const Unknowns& unknowns, const std::vector<double>& theta);

}  // namespace macadam::fitting
