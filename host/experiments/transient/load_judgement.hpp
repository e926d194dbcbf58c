// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_judgement.hpp  Judges a stepped test of a load as a whole: the work that became kinetic energy, and the
/// number of steps.
#pragma once

#include <string>
#include <vector>

#include "macadam/experiments/response.hpp"

namespace macadam {

/// Returns the largest kinetic energy divided by the work of the load; 0 if the load does no work. `volume`: of the
/// specimen's box [m³].
double kinetic_share(const std::vector<experiments::SteppedPoint>& points, double volume);

/// Returns a text that advises how to get fewer steps.
std::string fewer_steps();

}  // namespace macadam
