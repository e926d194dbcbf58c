// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_many.hpp  Several scenes in one process, side by side.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// A scene and the folder of its results.
struct SceneJob {
  Scene scene;
  std::filesystem::path out;
};

/// What became of it: a result, or an error.
struct JobOutcome {
  std::optional<RunResult> result;
  std::exception_ptr error;
};

struct ManyOptions {
  /// Scenes at a time; 0: four a device, so that the specimens of some are made while others are stepped, but no more
  /// than cores; without a device one a core. Two specimens a device are made and planned at a time; they share the
  /// cores, but for one a device where there are eight for each. Of several devices each has its first two one after
  /// the other, by twice as many cores, so that it need not wait long. Once the cells of a scene are made, it keeps
  /// half of its cores where others wait for some. Without a device each scene has an equal share of them, unless its
  /// [solver] threads says otherwise.
  int at_once = 0;
  bool resume = false;  ///< go on from checkpoints, where folders have them
  /// The functions but `stop` are called by one thread at a time. `job`: position in the list. What `done` throws ends
  /// all, once what runs has ended.
  std::function<void(std::size_t job, const std::string& stage, double share)> progress;
  std::function<void(std::size_t job, const std::string& warning)> warn;
  std::function<void(std::size_t job, const JobOutcome& outcome)> done;
  std::function<bool()> stop;  ///< as Watcher::stop, from several threads; scenes that have not begun do not begin then
};

/// run() of every scene, each on one device: an idle one, or the one that got the fewest so far, of those that its
/// [solver] names or, where it names none, of all that answer. When no scene is to come any more, a cyclic test goes to
/// the device that has less left to do for its next frequency. Small specimens share a device at the same time; of
/// others, the two that came first are stepped piece by piece. The results are those of run(). An error of one scene
/// ends no other, unless a device fails for a whole process; scenes that are on a device together share its memory.
/// Outcomes are in the order of the jobs; one that was not begun has an InterruptedError. \throws InputError where two
/// jobs have one folder.
std::vector<JobOutcome> run_many(const std::vector<SceneJob>& jobs, const ManyOptions& options = {});

}  // namespace macadam
