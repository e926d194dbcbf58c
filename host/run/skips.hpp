// SPDX-License-Identifier: GPL-3.0-or-later
/// \file skips.hpp  Lists the work and the files that a stepped run leaves out because its scene does not need them.
#pragma once

#include <optional>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// Return the skips that follow from the scene alone. geometry_skips(): the update of the geometry, if `geometry` is
/// fixed; if the largest `strain` of the run is known, the text gives the effect at this strain. asked_skips(): walls
/// and files that the scene does not request.
/// @{
std::vector<Skip> geometry_skips(Geometry geometry, std::optional<double> strain);
std::vector<Skip> asked_skips(const Scene& scene);
/// @}

/// Returns the skips of a planned run, which are decided before its first step. `strain`: the largest strain of the
/// run, if it is known. bench/skips measures each skip.
std::vector<Skip> find_skips(const Scene& scene, const Preparation& prepared, ContactForm form, Geometry geometry,
                             std::optional<double> strain);

}  // namespace macadam
