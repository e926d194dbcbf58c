// SPDX-License-Identifier: GPL-3.0-or-later
/// \file torsion_modulus.hpp  Computes the results of a torsion test from a steady state.
#pragma once

#include "macadam/experiments/frequency.hpp"
#include "macadam/harmonic.hpp"

namespace macadam {

/// Marks the moduli in `out` as shear moduli, and sets the torque per turn (docs/torsion.md, equation (T.1)).
/// `state`: a steady state in which the top wall turns; its moduli are G*.
void observe_torsion(const Specimen& specimen, const HarmonicResult& state, experiments::HarmonicFrequency& out);

}  // namespace macadam
