// SPDX-License-Identifier: GPL-3.0-or-later
/// \file skips.hpp  What an explicit run leaves out because its scene does not need it.
#pragma once

#include <vector>

#include "host/experiments/cyclic/plan.hpp"

namespace macadam {

/// The skips of a planned run, decided before its first step. bench/skips measures each.
std::vector<Skip> find_skips(const Scene& scene, const Preparation& prepared, const Plan& plan);

}  // namespace macadam
