// SPDX-License-Identifier: GPL-3.0-or-later
/// \file judgement.hpp  Checks whether a frequency's result can be right, as far as the result itself shows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// Returns the largest modulus that the network can have at a frequency [Pa], which is the modulus of its stiffest
/// contact. The cells fill the box, so ΣA·d·n_z² is its volume, and the affine motion gives no less energy than the
/// true one: the bound of Voigt.
double stiffest_contact(const Scene& scene, const ContactNetwork& network, double frequency_hz);

/// Stores in `fault` why the result cannot be right, if so, and adds a warning for each of these: a phase angle that a
/// passive specimen cannot have, a modulus above the modulus of the `stiffest` contact, a fit that leaves more than
/// half of the amplitude, walls that disagree, a tolerance that was not kept or that nothing could verify. Without a
/// harmonic solution, `kept` becomes false if there is a fault, or if the last two cycles differ by more than the
/// tolerance. `stiffest` is empty if a law is not linear; the result is then not checked against the limits for linear
/// specimens. \throws RunError for a modulus that is not a positive finite number.
void judge(experiments::SteppedFrequency& result, std::optional<double> stiffest, std::optional<double> tolerance,
           std::vector<std::string>& warnings);
void judge(experiments::HarmonicFrequency& result, double stiffest, std::vector<std::string>& warnings);

/// \throws RunError if a tolerance was asked for and a result cannot be right.
void require_sense(const Scene& scene, const experiments::SteppedCyclic& result);

}  // namespace macadam
