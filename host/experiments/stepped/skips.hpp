// SPDX-License-Identifier: GPL-3.0-or-later
/// \file skips.hpp  What an explicit run leaves out because its scene does not need it.
#pragma once

#include <optional>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// The skips of a planned run, decided before its first step; `strain`: that it goes to, where that is known.
/// bench/skips measures each.
std::vector<Skip> find_skips(const Scene& scene, const Preparation& prepared, ContactForm form, Geometry geometry,
                             std::optional<double> strain);

}  // namespace macadam
