// SPDX-License-Identifier: GPL-3.0-or-later
/// \file judgement.hpp  Checks whether a frequency's result can be right, as far as the result itself shows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// Returns an upper bound of the network's modulus at a frequency [Pa]: the modulus of its stiffest contact, or of the
/// rock with rule "series", whose contacts have mastic and rock in series. This modulus is a bound because the energy
/// of the affine motion is at least the energy of the true motion (Voigt's bound), and because the cells fill the box,
/// so that ΣA·d·n_z² over the contacts is the volume of the box.
double stiffest_contact(const Scene& scene, const ContactNetwork& network, double frequency_hz);

/// If the result cannot be right, stores the reason in `fault`. Adds a warning for each of these: a phase angle that a
/// specimen of springs and dashpots cannot have, a modulus above the modulus of the `stiffest` contact, a residual of
/// the fit above half of the amplitude, different forces on the two walls, a tolerance that was not kept or could not
/// be verified. Without a harmonic solution to compare with, sets `kept` of the result to false if there is a fault, or
/// if the last two cycles differ by more than the tolerance. `stiffest` is empty if a law is not linear. The function
/// then checks only that the modulus is a positive finite number, because the limits above hold for linear specimens.
/// \throws RunError for a modulus that is not a positive finite number.
void judge(experiments::SteppedFrequency& result, std::optional<double> stiffest, std::optional<double> tolerance,
           std::vector<std::string>& warnings);
void judge(experiments::HarmonicFrequency& result, double stiffest, std::vector<std::string>& warnings);

/// Ends a run that has a tolerance if one of its results cannot be right. \throws RunError
void require_sense(const Scene& scene, const experiments::SteppedCyclic& result);

}  // namespace macadam
