// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reduced_spectrum.hpp  The relaxation modulus of a specimen whose motions are restricted to those of a reduced
/// model.
#pragma once

#include "host/harmonic/reduced_model.hpp"
#include "macadam/spectrum.hpp"

namespace macadam::harmonic {

/// Returns all poles and residues of the reduced model as a series; E*(s) of the series equals that of the model at any
/// s. \param to_modulus  height over cross-section [1/m], which turns stiffness into modulus.
PronySeries reduced_spectrum(const ReducedModel& model, const std::array<std::optional<Law>, pair_types>& laws,
                             double to_modulus);

}  // namespace macadam::harmonic
