// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_ranks.hpp  One stepped run by several processes.
#pragma once

#include <filesystem>

#include "macadam/ranks.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// A folder that goes with this object.
class ScratchFolder {
 public:
  /// \throws RunError
  explicit ScratchFolder(int rank);
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The scene as this process runs it: on the device that is its own. \throws InputError for one that is not stepped on
/// devices.
Scene scene_of_rank(const Ranks& team, Scene scene);

/// \throws RunError where the ranks have read different scenes.
void require_same_scene(Ranks& team, const Scene& scene);

/// Gives all ranks the files of the first rank's folder that a run goes on from: those of `names` that are there.
/// \throws RunError
void hand_out(Ranks& team, const std::filesystem::path& folder, const std::vector<std::string>& names);

/// \throws RunError where the ranks have made different specimens.
void require_same_specimen(Ranks& team, const Preparation& prepared);

}  // namespace macadam
