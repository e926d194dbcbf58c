// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_load.hpp  Runs relaxation, creep and constant-rate tests in time steps.
#pragma once

#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

/// Plans one run from the beginning or from a checkpoint. Each point is written at once to the result file of this kind
/// of test. Decisions are stored in `result`. \throws InputError, which names the checkpoint if the checkpoint was
/// written on another machine and cannot be continued here; RunError as make_load_plan() and make_stepper() do.
std::unique_ptr<PlannedExperiment> plan_load_steps(const TransientExperiment& test, const Scene& scene,
                                                   const Preparation& prepared, const Watcher& watcher,
                                                   std::optional<Resumed> resumed, RunResult& result);

}  // namespace macadam
