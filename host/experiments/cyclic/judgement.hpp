// SPDX-License-Identifier: GPL-3.0-or-later
/// \file judgement.hpp  Whether a frequency's result can be right, as far as the result itself tells.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// The largest modulus that the network can have at a frequency: that of its stiffest contact. Cells fill the box, so
/// that ΣA·d·n_z² is its volume, and no motion gives less energy than the affine one gives: the bound of Voigt [Pa].
double stiffest_contact(const Scene& scene, const ContactNetwork& network, double frequency_hz);

/// Says what cannot be right (`fault`) and adds a warning for everything that a reader of this result must know: a
/// phase angle that no specimen has which only dissipates, a modulus above that of the `stiffest` contact, a fit that
/// leaves more than it takes, walls that disagree, a tolerance that was not kept or that nothing could verify. Without
/// a harmonic solution a tolerance is known not to be kept (`kept` is false) where there is a fault, or where the last
/// cycle still differs from the one before by more. Without a `stiffest`, where a law is not linear, nothing is held
/// against what linear specimens do. \throws RunError for a modulus that is no positive finite number.
void judge(experiments::SteppedFrequency& result, std::optional<double> stiffest, std::optional<double> tolerance,
           std::vector<std::string>& warnings);
void judge(experiments::HarmonicFrequency& result, double stiffest, std::vector<std::string>& warnings);

/// \throws RunError where a tolerance was asked for and a result cannot be right.
void require_sense(const Scene& scene, const experiments::SteppedCyclic& result);

}  // namespace macadam
