// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_load.hpp  Relaxation, creep and constant rates stepped in time.
#pragma once

#include "host/experiments/loaded/load_test.hpp"

namespace macadam {

/// From the beginning, or from where a checkpoint stands; each point goes to the kind's file at once. What was decided
/// goes into `result`. \throws InputError, also naming a checkpoint whose state is another machine's; RunError as
/// make_load_plan() and make_stepper() do.
std::unique_ptr<Solution> plan_load_steps(const LoadTest& test, const Scene& scene, const Preparation& prepared,
                                          const Watcher& watcher, std::optional<Resumed> resumed, RunResult& result);

}  // namespace macadam
