// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_words.hpp  Returns the sentences that a run reports about its specimen and its laws.
#pragma once

#include <string>

#include "macadam/simulation.hpp"

namespace macadam {

/// Returns what a run with the rule "series" or "volumetric" reports about the rock of its specimen.
std::string words_of(const RockReport& rock, const Specimen& specimen, ContactRule rule);

/// Returns the sentence of a run about air voids of a recipe that are not voids of the specimen; empty without such air
/// voids.
std::string words_of_air_voids(const Scene& scene);

/// Returns what a run reports about a mastic that is the specimen of another scene. Its law must be computed.
std::string words_of(const MasticSource& source);

}  // namespace macadam
