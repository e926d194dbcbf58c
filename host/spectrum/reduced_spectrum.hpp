// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reduced_spectrum.hpp  Computes the relaxation modulus of a reduced model.
#pragma once

#include "host/harmonic/reduced_model.hpp"
#include "macadam/spectrum.hpp"

namespace macadam::harmonic {

/// Returns the relaxation modulus of the reduced model as a sum of exponentials, from all poles and residues of the
/// model's E*(s). At any s the series has the same E*(s) as the model. If contacts have rock in series, the poles are
/// too many, and fewer exponentials reproduce E*(s) within about 1e-10. \param to_modulus  height over cross-section
/// [1/m], which turns stiffness into modulus.
PronySeries reduced_spectrum(const ReducedModel& model, const std::array<std::optional<Law>, pair_types>& laws,
                             double to_modulus);

}  // namespace macadam::harmonic
