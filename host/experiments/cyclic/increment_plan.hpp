// SPDX-License-Identifier: GPL-3.0-or-later
/// \file increment_plan.hpp  Plans cyclic tests that are followed by increments without inertia.
#pragma once

#include "host/experiments/cyclic/plan.hpp"
#include "host/quasi_static/quasi_static_stepper.hpp"

namespace macadam {

/// Plans increments: cycles, start, and the numbers of samples. A linear scene is solved in the frequency domain
/// without inertia, so that it starts in the steady state. Each sample has a thousand units of time, so that increments
/// can be shorter where cracks grow. \throws InputError for settings that do not apply to increments
Plan make_increment_plan(const Scene& scene, const Preparation& prepared, const Inertia& inertia,
                         const Watcher& watcher, Backend backend, PhaseSeconds& phases);

/// Returns a stepper for a frequency. It continues from `state`, the state in a checkpoint, unless that is empty.
/// `backend`: cpu or cuda.
std::unique_ptr<QuasiStaticStepper> make_cycle_increments(const Scene& scene, const Preparation& prepared,
                                                          const Plan& plan, const FrequencyPlan& frequency,
                                                          const std::vector<StateArray>& state, Backend backend);

}  // namespace macadam
