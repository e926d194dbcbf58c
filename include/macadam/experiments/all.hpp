// SPDX-License-Identifier: GPL-3.0-or-later
/// \file all.hpp  The one list of tests: what a scene may ask of its specimen.
#pragma once

#include <variant>

#include "macadam/experiments/creep.hpp"
#include "macadam/experiments/cyclic.hpp"
#include "macadam/experiments/monotonic.hpp"
#include "macadam/experiments/relaxation.hpp"
#include "macadam/experiments/response.hpp"
#include "macadam/experiments/sweep.hpp"

namespace macadam {

/// `[loading]`: one of these, by its `kind`.
using Experiment = std::variant<experiments::Cyclic, experiments::Sweep, experiments::Relaxation, experiments::Creep,
                                experiments::Monotonic>;

/// What they find, by the method that ran; none before.
using ExperimentResult =
    std::variant<std::monostate, experiments::SteppedCyclic, experiments::HarmonicCyclic, experiments::SweepResult,
                 experiments::SpectrumResponse, experiments::SteppedResponse>;

}  // namespace macadam
