// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_judgement.hpp  Judges a stepped test of a load as a whole: the work that became kinetic energy, the
/// number of steps, and the increments of a quasi-static test.
#pragma once

#include <string>
#include <vector>

#include "host/quasi_static/quasi_static_stepper.hpp"
#include "macadam/experiments/response.hpp"

namespace macadam {

/// Returns the largest kinetic energy divided by the work of the load; 0 if the load does no work. `volume`: of the
/// specimen's box [m³].
double kinetic_share(const std::vector<experiments::SteppedPoint>& points, double volume);

/// Returns a text that advises how to get fewer steps.
std::string fewer_steps();

/// Returns the numbers and errors of the increments until now.
experiments::Increments increments_found(const QuasiStaticStepper& stepper);

/// Adds a warning if the wall had to be controlled by the opening of cracks, and a warning if particles had separated.
void warn_of_increments(const quasi_static::CourseReport& report, std::vector<std::string>& warnings);

}  // namespace macadam
