// SPDX-License-Identifier: GPL-3.0-or-later
/// \file skips.hpp  Lists what an explicit run leaves out because its scene does not need it.
#pragma once

#include <optional>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// Returns the skips of a planned run, which are decided before its first step. `strain`: the largest strain of the
/// run, if it is known. bench/skips measures each skip.
std::vector<Skip> find_skips(const Scene& scene, const Preparation& prepared, ContactForm form, Geometry geometry,
                             std::optional<double> strain);

}  // namespace macadam
