// SPDX-License-Identifier: GPL-3.0-or-later
/// \file skips.hpp  Lists the work and the files that a stepped run leaves out because its scene does not need them.
#pragma once

#include <optional>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// Return the skips (parts of a run that are left out) that follow from the scene alone. geometry_skips() returns the
/// update of the geometry, if `geometry` is fixed. If the largest `strain` of the run is known, the text of this skip
/// gives the effect at this strain. asked_skips() returns the walls and files that the scene does not request.
/// @{
std::vector<Skip> geometry_skips(Geometry geometry, std::optional<double> strain);
std::vector<Skip> asked_skips(const Scene& scene);
/// @}

/// Returns all skips of a planned run. They are decided before the first step of the run. `strain`: the largest strain
/// of the run, if it is known. bench/skips measures each skip.
std::vector<Skip> find_skips(const Scene& scene, const Preparation& prepared, ContactForm form, Geometry geometry,
                             std::optional<double> strain);

}  // namespace macadam
