// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_ranks.hpp  Performs one stepped run by several processes, the ranks.
#pragma once

#include <filesystem>

#include "macadam/ranks.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// A temporary folder that is removed with this object.
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

/// Returns the scene with the device of this rank in place of its devices. \throws InputError for a scene that is not
/// stepped on devices.
Scene scene_of_rank(const Ranks& team, Scene scene);

/// Checks that all ranks have read the same scene. \throws RunError if they have read different scenes.
void require_same_scene(Ranks& team, const Scene& scene);

/// Copies the files `names`, if they exist in the first rank's folder, to the folders of all ranks. The run continues
/// from these files.
/// \throws RunError
void hand_out(Ranks& team, const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Checks that all ranks have made the same specimen. \throws RunError if their specimens differ.
void require_same_specimen(Ranks& team, const Preparation& prepared);

}  // namespace macadam
