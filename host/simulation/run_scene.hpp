// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_scene.hpp  Declares run_scene(), which is run() with two parts that run_many() replaces: the preparation
/// and the choice of devices.
#pragma once

#include "macadam/simulation.hpp"

namespace macadam {

/// Name of the stage of prepare() in which the contact network is made; it follows the stage of the Laguerre cells.
inline constexpr const char* network_stage = "contact network";

/// Parts of run_scene() that the caller may replace.
struct RunParts {
  /// Makes particles and contacts. If this function is empty, prepare() makes them.
  std::function<Preparation(const Scene& scene, const Progress& progress)> prepare;
  /// Chooses the devices, if the backend is cuda, when the scene is prepared. If this function is empty,
  /// choose_devices() chooses the devices of stepped runs.
  std::function<void(SolverSpec& solver)> place;
};

/// Runs a scene as run() does. `given`: the scene's preparation, if it exists already.
RunResult run_scene(Scene scene, const std::filesystem::path& out, const Watcher& watcher, bool resume,
                    const RunParts& parts, const Preparation* given = nullptr);

}  // namespace macadam
