// SPDX-License-Identifier: GPL-3.0-or-later
/// \file beam_modulus.hpp  Computes the complex modulus of a beam between rollers from its deflection and from the
/// loads of the rollers.
#pragma once

#include "macadam/experiments/bending.hpp"
#include "macadam/experiments/frequency.hpp"
#include "macadam/harmonic.hpp"

namespace macadam {

/// Replaces the moduli in `out` by those of the beam, and sets the compliances of the beam (docs/bending.md).
/// `specimen`: its domain has rollers. `laws`: the laws with which `state` was solved. \throws RunError if no particle
/// lies at a place where the deflection is measured.
void observe_beam(const experiments::Bending& test, const Specimen& specimen, const ContactNetwork& network,
                  const LawTable& laws, const HarmonicResult& state, experiments::HarmonicFrequency& out);

}  // namespace macadam
