// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_scene.hpp  run(), with parts that run_many() does in its own way.
#pragma once

#include "macadam/simulation.hpp"

namespace macadam {

/// The stage of prepare() that follows on the cells.
inline constexpr const char* network_stage = "contact network";

struct RunParts {
  /// Makes particles and contacts; prepare() where there is none.
  std::function<Preparation(const Scene& scene, const Progress& progress)> prepare;
  /// Names the devices, where the backend is cuda and all is prepared; where there is none, choose_devices() does, for
  /// steps.
  std::function<void(SolverSpec& solver)> place;
};

/// As run().
RunResult run_scene(Scene scene, const std::filesystem::path& out, const Watcher& watcher, bool resume,
                    const RunParts& parts, const Preparation* given = nullptr);

}  // namespace macadam
