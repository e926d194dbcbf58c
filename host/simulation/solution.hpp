// SPDX-License-Identifier: GPL-3.0-or-later
/// \file solution.hpp  The two ways from a prepared scene to |E*| and φ. Each is planned first, so that whatever
/// refuses a scene does so before a file of the folder is touched.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "host/simulation/checkpoints.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// Writes summary.json with a status.
using Saving = std::function<void(const std::string& status)>;

/// A planned way; scene, preparation and watcher must outlive it.
class Solution {
 public:
  virtual ~Solution() = default;

  /// Finds every frequency: each goes into `result` and is saved as soon as it is there. \throws DivergenceError naming
  /// the particle that left the range of sense first; InterruptedError; RunError as Harmonic does.
  virtual void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) = 0;

  /// Whether a checkpoint in the folder is this run's own.
  virtual bool owns_checkpoint() const { return false; }
};

/// Steps in time, from the beginning or from where a checkpoint stands; each sample goes to response.csv at once.
/// What was decided goes into `result`. \throws InputError, also naming the `checkpoint` whose state is another
/// machine's; RunError as make_plan() and make_stepper() do.
std::unique_ptr<Solution> plan_steps(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                     std::optional<RunState> resumed, const std::filesystem::path& checkpoint,
                                     RunResult& result);

/// Solves the steady states (method "harmonic"). \throws as the constructor of Harmonic does.
std::unique_ptr<Solution> plan_harmonic(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                        RunResult& result);

/// Density scaling that the scene gives for a frequency; 1 where it gives none.
double density_scaling_of(const SolverSpec& solver, std::size_t frequency);

}  // namespace macadam
