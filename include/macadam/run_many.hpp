// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_many.hpp  Runs several scenes in one process at the same time.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// A scene and the folder for its results.
struct SceneJob {
  Scene scene;
  std::filesystem::path out;
};

/// The result of a job, or its error.
struct JobOutcome {
  std::optional<RunResult> result;
  std::exception_ptr error;
};

/// Options and callbacks of run_many().
struct ManyOptions {
  /// Number of scenes at a time. 0: four per device (GPU), so that some specimens are prepared while others are
  /// stepped, but not more scenes than cores; without a device, one per core.
  ///
  /// Two specimens per device are prepared and planned at a time. They share the cores; one core per device is left
  /// free if there are at least eight cores per device. With several devices, the first two specimens of each device
  /// are prepared one after the other with twice the number of cores, so that the device need not wait long. When a
  /// scene has finished its tessellation, it keeps half of its cores, and waiting scenes get the other half. Without a
  /// device the scenes have equal numbers of cores, unless [solver] threads says otherwise.
  int at_once = 0;
  bool resume = false;  ///< continue from checkpoints, in folders that have them
  /// Called by one thread at a time, as are `warn` and `done`. `job`: position in the list. If `done` throws, no scene
  /// is begun any more, and the exception leaves run_many() once the running scenes have ended.
  std::function<void(std::size_t job, const std::string& stage, double share)> progress;
  std::function<void(std::size_t job, const std::string& warning)> warn;
  std::function<void(std::size_t job, const JobOutcome& outcome)> done;
  /// Has the meaning of Watcher::stop; called by several threads. Once it returns true, no further scene is begun.
  std::function<bool()> stop;
};

/// Calls run() for every scene, each on one device. A scene may use the devices that its [solver] names or, if it names
/// none, all usable devices. The scene gets an idle one of these devices or, if none is idle, the one that has been
/// given the fewest scenes so far. Once all scenes have begun, a cyclic test may continue with its next frequency on
/// another device, if the scenes on that device have less work left. Several small specimens on one device are stepped
/// at the same time. Larger specimens cannot be stepped at the same time: the two scenes that came first take turns,
/// each for a short time. The results are the same as those of run(). An error of one scene does not end the others,
/// unless it makes a device unusable for the whole process. Scenes on the same device share its memory, so a scene can
/// run out of memory because of another one.
///
/// Returns the outcomes in the order of the jobs; a job that was not begun has an InterruptedError. \throws InputError
/// if two jobs have the same folder.
std::vector<JobOutcome> run_many(const std::vector<SceneJob>& jobs, const ManyOptions& options = {});

}  // namespace macadam
