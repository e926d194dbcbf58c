// SPDX-License-Identifier: GPL-3.0-or-later
/// \file planned_experiment.hpp  Defines a planned experiment. When a PlannedExperiment has been made, every check that
/// can refuse the scene has passed, and no file in the folder of the results has been changed yet.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "macadam/simulation.hpp"

namespace macadam {

/// A function that writes summary.json, with `status` as the status of the run.
using Saving = std::function<void(const std::string& status)>;

/// A planned experiment. Scene, preparation and watcher must outlive it.
class PlannedExperiment {
 public:
  virtual ~PlannedExperiment() = default;

  /// Runs the experiment. Results are stored in `result` and saved as soon as they are known. \throws DivergenceError
  /// naming the particle that first left the plausible range; InterruptedError; RunError when a frequency-domain
  /// solution does not reach its tolerance (see Harmonic).
  virtual void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) = 0;

  /// Returns whether a checkpoint in the folder belongs to this run.
  virtual bool owns_checkpoint() const { return false; }
};

}  // namespace macadam
