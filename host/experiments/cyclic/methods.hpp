// SPDX-License-Identifier: GPL-3.0-or-later
/// \file methods.hpp  Declares the two methods that compute |E*| and φ of a prepared scene: time steps, and steady
/// states in the frequency domain.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "host/experiments/experiment.hpp"

namespace macadam {

/// Plans a run that follows the cycles in time, by steps or by increments, from the beginning or from a checkpoint.
/// Each sample is written to response.csv at once. Decisions are stored in `result`. \throws InputError, which names
/// the checkpoint if the checkpoint was written on another machine and cannot be continued here; RunError as
/// make_plan() and make_stepper() do.
std::unique_ptr<PlannedExperiment> plan_steps(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                              std::optional<Resumed> resumed, RunResult& result);

/// Returns the result of a frequency with those members set that both methods have in common.
experiments::Frequency frequency_of(const Scene& scene, double frequency_hz, std::optional<double> temperature_c,
                                    double density_scaling, const Stiffness& stiffness, double seconds);

/// A function that returns the list in a result to which solved steady states are added.
using ListOfStates = std::vector<experiments::HarmonicFrequency>& (*)(RunResult& result);

/// Plans a run that solves the steady states of all frequencies and temperatures of the experiment. The run adds them
/// to a list in the result. \throws as the constructor of Harmonic does.
std::unique_ptr<PlannedExperiment> plan_harmonic(const Scene& scene, const Preparation& prepared,
                                                 const Watcher& watcher, RunResult& result, ListOfStates states);

/// Writes the results of a sweep to a table in the folder of a run.
using TableOfSweep = std::function<void(const std::filesystem::path& out, const experiments::SweepResult& found)>;

/// Plans the same run as plan_harmonic(). Its result is a SweepResult; `write` is called whenever the summary is saved.
std::unique_ptr<PlannedExperiment> plan_sweep(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                              RunResult& result, TableOfSweep write);

}  // namespace macadam
