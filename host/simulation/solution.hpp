// SPDX-License-Identifier: GPL-3.0-or-later
/// \file solution.hpp  The two ways from a prepared scene to |E*| and φ.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "host/simulation/checkpoints.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// Writes summary.json with a status.
using Saving = std::function<void(const std::string& status)>;

/// Steps every frequency in time, from the beginning or from where a checkpoint stands; each sample goes to
/// response.csv in `out` and each finished frequency into `result` at once.
/// \throws DivergenceError naming the particle that left the range of sense first; InterruptedError.
void step_frequencies(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out,
                      const Watcher& watcher, const Saving& save, std::optional<RunState> resumed, RunResult& result);

/// Solves every frequency's steady state (method "harmonic"). \throws as Harmonic does.
void solve_frequencies(const Scene& scene, const Preparation& prepared, const Progress& progress, const Saving& save,
                       RunResult& result);

/// Density scaling that the scene gives for a frequency; 1 where it gives none.
double density_scaling_of(const SolverSpec& solver, std::size_t frequency);

}  // namespace macadam
