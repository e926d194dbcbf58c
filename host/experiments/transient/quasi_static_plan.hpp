// SPDX-License-Identifier: GPL-3.0-or-later
/// \file quasi_static_plan.hpp  Plans tests whose load is applied in increments without inertia.
#pragma once

#include "host/experiments/transient/load_plan.hpp"
#include "host/quasi_static/quasi_static_stepper.hpp"

namespace macadam {

/// Chooses the unit of time, of which all increments are whole numbers, and the ramp that replaces a sudden load. The
/// plan's dt is this unit. \throws InputError for settings that do not apply to increments.
LoadPlan make_quasi_static_plan(const TransientExperiment& test, const Scene& scene, const Preparation& prepared);

/// Returns how the increments follow the test, except for the drive.
quasi_static::CourseOptions course_options(const TransientExperiment& test, const LoadPlan& plan, const Scene& scene,
                                           const Preparation& prepared);

}  // namespace macadam
