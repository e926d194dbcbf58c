// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_load.hpp  Steps relaxation, creep and constant rates in time.
#pragma once

#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

/// Plans one run from the beginning or from a checkpoint. Each point is written to the kind's file at once. Decisions
/// are stored in `result`. \throws InputError, also naming a checkpoint whose state is from another machine; RunError
/// as make_load_plan() and make_stepper() do.
std::unique_ptr<PlannedExperiment> plan_load_steps(const TransientExperiment& test, const Scene& scene,
                                                   const Preparation& prepared, const Watcher& watcher,
                                                   std::optional<Resumed> resumed, RunResult& result);

}  // namespace macadam
