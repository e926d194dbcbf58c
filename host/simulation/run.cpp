// SPDX-License-Identifier: GPL-3.0-or-later
// run.cpp  Runs a scene in this process alone, or as one of several ranks.
#include "macadam/simulation.hpp"

#include <optional>

#include "host/run/checkpoints.hpp"
#include "host/simulation/run_ranks.hpp"
#include "host/simulation/run_scene.hpp"

namespace macadam {
namespace {

/// Does the same as run_scene(), in this process alone or as one of several ranks.
RunResult run_alone_or_together(const Scene& scene, const std::filesystem::path& out, const Watcher& watcher,
                                bool resume, const Preparation* given) {
  Ranks* const team = ranks();
  if (!team) return run_scene(scene, out, watcher, resume, {}, given);
  require_same_scene(*team, scene);
  const Scene own = scene_of_rank(*team, scene);
  std::optional<ScratchFolder> scratch;
  if (!is_first_rank()) scratch.emplace(team->number());
  const std::filesystem::path& folder = scratch ? scratch->path() : out;
  if (resume) hand_out(*team, folder, {checkpoint_name, previous_checkpoint_name});
  Watcher watching = watcher;
  watching.prepared = [&](const Preparation& prepared) {
    require_same_specimen(*team, prepared);
    if (watcher.prepared) watcher.prepared(prepared);
  };
  RunResult result = run_scene(own, folder, watching, resume, {}, given);
  team->any(false);  // waits until the first rank has written everything, because a rank that ends may end the others
  return result;
}

}  // namespace

RunResult run(const Scene& scene, const std::filesystem::path& out, const Watcher& watcher, bool resume) {
  return run_alone_or_together(scene, out, watcher, resume, nullptr);
}

RunResult run(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out, const Watcher& watcher,
              bool resume) {
  return run_alone_or_together(scene, out, watcher, resume, &prepared);
}

}  // namespace macadam
