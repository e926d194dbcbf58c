// SPDX-License-Identifier: GPL-3.0-or-later
/// \file constant_approach.hpp  Describes tests in which the two loaded walls approach each other at a constant rate.
#pragma once

#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

/// Returns the description of such a test. `times`: times of the result [s]; `rate`: rate of the approach [m/s];
/// `length`: distance of the walls [m]; `rows`: TransientExperiment::rows.
TransientExperiment constant_approach(const char* kind, const std::vector<double>& times, double rate, double length,
                                      const char* rows);

}  // namespace macadam
