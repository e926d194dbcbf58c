// SPDX-License-Identifier: GPL-3.0-or-later
/// \file all.hpp  Lists the experiments that a scene may request.
#pragma once

#include <variant>

#include "macadam/experiments/creep.hpp"
#include "macadam/experiments/cyclic.hpp"
#include "macadam/experiments/monotonic.hpp"
#include "macadam/experiments/relaxation.hpp"
#include "macadam/experiments/response.hpp"
#include "macadam/experiments/sweep.hpp"

namespace macadam {

/// The `[loading]` of a scene: one of these, by its `kind`.
using Experiment = std::variant<experiments::Cyclic, experiments::Sweep, experiments::Relaxation, experiments::Creep,
                                experiments::Monotonic>;

/// The result of an experiment, by the method that ran; monostate before a run.
using ExperimentResult =
    std::variant<std::monostate, experiments::SteppedCyclic, experiments::HarmonicCyclic, experiments::SweepResult,
                 experiments::SpectrumResponse, experiments::SteppedResponse>;

}  // namespace macadam
