// SPDX-License-Identifier: GPL-3.0-or-later
/// \file solution.hpp  A test that is planned: whatever refuses a scene has done so before a file of the folder is
/// touched.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "macadam/simulation.hpp"

namespace macadam {

/// Writes summary.json with a status.
using Saving = std::function<void(const std::string& status)>;

/// A planned test; scene, preparation and watcher must outlive it.
class Solution {
 public:
  virtual ~Solution() = default;

  /// Finds the answer: what is found goes into `result` and is saved as soon as it is there. \throws DivergenceError
  /// naming the particle that left the range of sense first; InterruptedError; RunError as Harmonic does.
  virtual void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) = 0;

  /// Whether a checkpoint in the folder is this run's own.
  virtual bool owns_checkpoint() const { return false; }
};

}  // namespace macadam
