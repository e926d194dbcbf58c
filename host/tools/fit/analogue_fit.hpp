// SPDX-License-Identifier: GPL-3.0-or-later
/// \file analogue_fit.hpp  Fits 2S2P1D or Huet–Sayegh to moduli.
#pragma once

#include <vector>

#include "host/tools/fit/least_squares.hpp"

namespace macadam::fitting {

/// Returns bounds for the unknowns of the model.
std::vector<Limits> analogue_limits(const Unknowns& unknowns, const std::vector<Target>& targets);

/// Returns the model with the smallest misfit that the best of many starts reach, with k < h. `shift` and `limits` are
/// as for fit_chain(). 2S2P1D also starts from the Huet–Sayegh model, which it contains; a free shift also starts from
/// `contained`, fits with shift laws that are converted to these unknowns. The misfit is not above theirs.
Minimum fit_analogue(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
                     const std::vector<double>& shift, const std::vector<std::vector<double>>& contained = {});

/// Returns the model with the constants θ.
AnalogueModel analogue_of(const Unknowns& unknowns, const std::vector<double>& theta);

}  // namespace macadam::fitting
