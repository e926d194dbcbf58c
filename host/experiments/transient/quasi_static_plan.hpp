// SPDX-License-Identifier: GPL-3.0-or-later
/// \file quasi_static_plan.hpp  Plans tests whose load is applied in increments without inertia.
#pragma once

#include "host/experiments/transient/load_plan.hpp"
#include "host/quasi_static/quasi_static_stepper.hpp"

namespace macadam {

/// Chooses the unit of time and the ramp that replaces a sudden load. Every increment lasts a whole number of units.
/// The plan's dt is the unit. \throws InputError for settings that do not apply to increments.
LoadPlan make_quasi_static_plan(const TransientExperiment& test, const Scene& scene, const Preparation& prepared);

/// Returns the options of the increments of a test. The caller must still set the drive.
quasi_static::CourseOptions course_options(const TransientExperiment& test, const LoadPlan& plan, const Scene& scene,
                                           const Preparation& prepared);

}  // namespace macadam
