// SPDX-License-Identifier: GPL-3.0-or-later
// run.cpp  Does the main job: prepares a scene, runs its experiment, and leaves complete files whatever happens. The
// result folder is locked first. Older results in it are replaced only after the specimen is made and the experiment is
// planned.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <future>
#include <new>

#include "host/experiments/experiment.hpp"
#include "host/fields/field_output.hpp"
#include "host/files/result_files.hpp"
#include "host/files/result_folder.hpp"
#include "host/run/checkpoints.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "host/run/phases.hpp"
#include "host/simulation/preparation_files.hpp"
#include "host/simulation/run_ranks.hpp"
#include "host/simulation/run_scene.hpp"
#include "host/run/sparing_save.hpp"
#include "host/run/planned_experiment.hpp"
#include "host/simulation/summary.hpp"
#include "host/backends/choose_devices.hpp"
#include "host/backends/cuda_code.hpp"
#include "host/tessellation/packing_check.hpp"
#include "host/base/thread_limit.hpp"
#include "macadam/error.hpp"
#include "macadam/simulation.hpp"

namespace macadam {
namespace {

/// \throws InputError if runs of this scene keep no checkpoints.
void require_resumable(const Scene& scene) {
  std::string why_not;
  if (!keeps_checkpoints(scene, scene.solver.backend, &why_not))
    throw InputError(scene.file.string() + ": cannot be resumed: " + why_not);
}

/// Removes the result files of an older run. Its checkpoint may stay, because it is not a result.
void remove_results(const std::filesystem::path& out) {
  for (const std::string& name : result_files()) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(out / name, error)) continue;
    if (!std::filesystem::remove(out / name, error)) {
      throw RunError((out / name).string() + ": cannot be replaced: " + error.message());
    }
  }
}

/// Removes the checkpoint of this run or of an earlier run of the same scene, because the results to which it would
/// lead exist now. A checkpoint that cannot be removed costs only disk space.
void remove_own_checkpoint(const std::filesystem::path& out, const Scene& scene, Backend backend, bool own) {
  std::error_code ignored;
  for (const char* name : {checkpoint_name, previous_checkpoint_name}) {
    const std::filesystem::path file = out / name;
    if (!own && !is_checkpoint_of(file, scene, backend)) continue;
    std::filesystem::remove(file, ignored);
    std::filesystem::remove(file.string() + ".part", ignored);  // left by a kill while a checkpoint was written
  }
}

/// Returns the status for summary.json after an error.
std::string status_of(const std::exception& error) {
  if (dynamic_cast<const InterruptedError*>(&error)) return "interrupted";
  if (dynamic_cast<const std::bad_alloc*>(&error)) return "failed: out of memory";
  return std::string("failed: ") + error.what();
}

/// The backend that runs the scene. Devices are counted and start up while the specimen is made.
class FoundBackend {
 public:
  /// Waits at most for `wait`. \throws as select_backend(), if it fails within that time. A refusal by an existing
  /// device may become known later.
  FoundBackend(const SolverSpec& solver, std::chrono::milliseconds wait) : asked_(solver.backend) {
    const auto select = [solver] { return select_backend(solver.backend, nullptr, solver.devices); };
    if (asked_ == Backend::cuda || asked_ == Backend::automatic) {
      waking_ = std::async(select);  // runs in this thread if no other thread can be started
      waking_.wait_for(wait);
      look();
    } else {
      asked_ = select();
    }
  }
  /// Checks whether the search for a backend has failed by now, so that a scene that cannot run is not prepared to the
  /// end. \throws as select_backend() if it has.
  void look() {
    if (waking_.valid() && waking_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) get();
  }
  /// Waits for the backend and returns it. \throws as select_backend().
  Backend get() { return waking_.valid() ? asked_ = waking_.get() : asked_; }

 private:
  Backend asked_;
  std::future<Backend> waking_;
};

}  // namespace

RunResult run_scene(Scene scene, const std::filesystem::path& out, const Watcher& watcher, bool resume,
                    const RunParts& parts, const Preparation* given) {
  require_combination(scene);
  const ThreadLimit threads(scene.solver.threads);
  RunResult result;
  std::optional<InPhase> starting(std::in_place, result.phases, &PhaseSeconds::start);
  const bool stepped = scene.solver.method == SolverMethod::explicit_;
  FoundBackend backend(scene.solver, parts.place ? std::chrono::milliseconds(0) : none_is_known_within);
  if (resume) require_resumable(scene);
  const ResultFolder folder(out);
  std::optional<Resumed> resumed;
  std::string damage;  // of the newest checkpoint
  if (resume) {
    FoundCheckpoint found = find_checkpoint(out, scene, backend.get());
    resumed = Resumed{std::move(found.checkpoint), found.file};
    damage = std::move(found.damage);
  }
  starting.reset();
  std::optional<Preparation> made;
  if (given) {
    require_laws(scene, given->specimen, given->network);
  } else {
    const Progress look_too = [&](const std::string& stage, double share) {
      backend.look();
      if (watcher.progress) watcher.progress(stage, share);
    };
    made = parts.prepare ? parts.prepare(scene, look_too) : prepare(scene, look_too);
  }
  const Preparation& prepared = given ? *given : *made;
  {
    const InPhase waiting(result.phases, &PhaseSeconds::start);
    result.backend = backend.get();
  }
  if (!resume && stepped && watcher.warn && is_checkpoint_of(out / checkpoint_name, scene, result.backend))
    watcher.warn((out / checkpoint_name).string() +
                 ": this run was begun before and now starts again; --resume would continue it");
  if (resumed) require_same_specimen(resumed->file, resumed->checkpoint, prepared);
  if (!damage.empty()) {
    std::error_code error;
    std::filesystem::rename(resumed->file, out / checkpoint_name, error);
    if (error) throw RunError(resumed->file.string() + ": cannot become " + checkpoint_name + ": " + error.message());
    damage = "the run continues from the previous checkpoint, because the newest one is missing or damaged: " + damage;
    if (watcher.warn) watcher.warn(damage);
  }
  if (watcher.prepared) watcher.prepared(prepared);
  const std::vector<std::string> packing = packing_warnings(prepared.specimen, prepared.tessellation);
  if (watcher.warn) std::ranges::for_each(packing, watcher.warn);
  std::string devices_decision;
  if (result.backend == Backend::cuda) {
    if (parts.place)
      parts.place(scene.solver);
    else if (stepped && scene.solver.devices.empty())
      scene.solver.devices = choose_devices(prepared.network.contacts.size(), devices_decision);
  }

  const Saving save = [&](const std::string& status) {
    const InPhase writing(result.phases, &PhaseSeconds::writing);
    write_whole(out / "summary.json", summary_json(scene, prepared, result, status));
  };
  std::unique_ptr<Solution> solution;
  std::exception_ptr unsolvable;
  try {
    solution = plan_experiment(scene, prepared, watcher, std::move(resumed), result);
  } catch (const InterruptedError&) {
    throw InterruptedError(
        "interrupted while planning; nothing was written, and the files in the folder are unchanged");
  } catch (const RunError&) {
    if (std::filesystem::exists(out / "summary.json")) throw;
    // without older results, the specimen is written all the same, so that the user can look at it
    unsolvable = std::current_exception();
  }
  if (!devices_decision.empty()) result.decisions.push_back(devices_decision);
  if (!damage.empty()) result.warnings.push_back(damage);
  result.warnings.insert(result.warnings.end(), packing.begin(), packing.end());
  if (scene.network.lateral_walls) {
    result.warnings.emplace_back(
        "the sides are held, so the moduli are confined moduli, not |E*| or E(t) of a specimen with free sides");
  }
  // the last point at which an interruption leaves no trace
  if (watcher.progress) watcher.progress("writing the specimen", 0);
  {
    const InPhase writing(result.phases, &PhaseSeconds::writing);
    write_preparation(scene, prepared, out, [&] {
      remove_results(out);
      if (!resume) remove_fields(out);
    });
  }
  try {
    if (unsolvable) std::rethrow_exception(unsolvable);
    if (watcher.planned) watcher.planned(result);
    solution->solve(out, SparingSave(save), result);
  } catch (const std::exception& error) {
    try {
      save(status_of(error));
    } catch (const std::exception&) {  // a full disk may be the reason for the first error, which is the one to report
    }
    throw;
  }
  save("done");
  if (stepped) remove_own_checkpoint(out, scene, result.backend, solution->owns_checkpoint());
  return result;
}

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
  team->any(false);  // by then the first rank has written everything: a rank that ends may end the others
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
