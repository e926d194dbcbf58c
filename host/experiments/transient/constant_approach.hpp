// SPDX-License-Identifier: GPL-3.0-or-later
/// \file constant_approach.hpp  Describes and plans tests in which the two loaded walls approach each other at a
/// constant rate.
#pragma once

#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

/// Returns the description of such a test. `times`: times of the result [s]; `rate`: rate of the approach [m/s];
/// `length`: distance of the walls [m]; `rows`: TransientExperiment::rows.
TransientExperiment constant_approach(const char* kind, const std::vector<double>& times, double rate, double length,
                                      const char* rows);

/// Plans such a test of a specimen on rollers. `domain`: name of the domain that the test needs. \throws InputError if
/// the specimen has another domain or no rollers, and as plan_load_test() does.
std::unique_ptr<PlannedExperiment> plan_on_rollers(const TransientExperiment& test, const std::string& domain,
                                                   const Scene& scene, const Preparation& prepared,
                                                   const Watcher& watcher, std::optional<Resumed> resumed,
                                                   RunResult& result);

}  // namespace macadam
