// SPDX-License-Identifier: GPL-3.0-or-later
/// \file increment_words.hpp  What a run by increments without inertia reports: their numbers and errors, and warnings.
#pragma once

#include <string>
#include <vector>

#include "host/quasi_static/quasi_static_stepper.hpp"
#include "macadam/experiments/increments.hpp"

namespace macadam {

/// Returns the numbers and errors of the increments until now.
experiments::Increments increments_found(const QuasiStaticStepper& stepper);

/// Returns a warning if the wall had to be controlled by the opening of cracks, and one if particles had separated.
std::vector<std::string> increment_warnings(const QuasiStaticStepper& stepper);

}  // namespace macadam
