// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reduced_spectrum.hpp  The relaxation of a specimen held to the motions of a reduced model.
#pragma once

#include "host/harmonic/reduced_model.hpp"
#include "macadam/spectrum.hpp"

namespace macadam::harmonic {

/// All poles and residues: E*(s) of the series is that of the model, at any s. \param to_modulus  height over area.
PronySeries reduced_spectrum(const ReducedModel& model, const std::array<std::optional<Law>, pair_types>& laws,
                             double to_modulus);

}  // namespace macadam::harmonic
