// SPDX-License-Identifier: GPL-3.0-or-later
/// \file analogue_fit.hpp  Fits 2S2P1D or Huet–Sayegh to moduli.
#pragma once

#include <vector>

#include "host/tools/fit/problem.hpp"

namespace macadam::fitting {

/// Fits the problem's model and shift law from many starts, refines the best of them, and returns the result with the
/// smallest misfit. The result has k < h. All smaller models are fitted first: 2S2P1D contains Huet–Sayegh, and
/// contained_shift_laws() are the smaller shift laws. The fit of each model also starts from the fitted models that it
/// contains, so its misfit is never larger than the misfits of these models. \throws RunError if no start has a finite
/// misfit.
Minimum fit_analogue(const Problem& problem);

/// Returns the model with the constants θ.
AnalogueModel analogue_of(const Unknowns& unknowns, const std::vector<double>& theta);

}  // namespace macadam::fitting
