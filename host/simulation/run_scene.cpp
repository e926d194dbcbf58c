// SPDX-License-Identifier: GPL-3.0-or-later
// run_scene.cpp  Does the main job: prepares a scene, runs its experiment, and leaves complete files whatever happens.
// The result folder is locked first. Older results in it are replaced only after the specimen is made and the
// experiment is planned.
#include "host/simulation/run_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <optional>

#include "host/experiments/experiment.hpp"
#include "host/fields/field_output.hpp"
#include "host/files/result_files.hpp"
#include "host/files/result_folder.hpp"
#include "host/run/checkpoints.hpp"
#include "host/run/model_error.hpp"
#include "host/run/phases.hpp"
#include "host/run/planned_experiment.hpp"
#include "host/run/sparing_save.hpp"
#include "host/simulation/found_backend.hpp"
#include "host/simulation/old_results.hpp"
#include "host/simulation/preparation_files.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "host/simulation/run_words.hpp"
#include "host/simulation/summary.hpp"
#include "host/backends/cuda_code.hpp"
#include "macadam/error.hpp"
#include "macadam/tessellation.hpp"
#include "macadam/thread_limit.hpp"

namespace macadam {
namespace {

/// Checks that runs of this scene can be resumed. \throws InputError if they keep no checkpoints.
void require_resumable(const Scene& scene) {
  std::string why_not;
  if (!keeps_checkpoints(scene, scene.solver.backend, &why_not))
    throw InputError(scene.file.string() + ": cannot be resumed: " + why_not);
}

/// Returns the status for summary.json after an error.
std::string status_of(const std::exception& error) {
  if (dynamic_cast<const InterruptedError*>(&error)) return "interrupted";
  if (dynamic_cast<const std::bad_alloc*>(&error)) return "failed: out of memory";
  return std::string("failed: ") + error.what();
}

/// Checks that contacts which were made for another scene have the rule of this scene. \throws InputError.
void require_same_rule(const Scene& scene, const ContactNetwork& network) {
  if (network.rule != scene.network.rule)
    throw InputError(scene.file.string(), 0, "rule in [network]",
                     std::string("\"") + to_string(scene.network.rule) + '"',
                     std::string("\"") + to_string(network.rule) + "\", the rule of the given contacts");
  if (network.rule == ContactRule::centres) return;
  const auto require = [&](const char* key, double found, double expected) {
    if (found != expected)
      throw InputError(scene.file.string(), 0, key, fmt::format("{}", found),
                       fmt::format("{}, with which the lengths of the given contacts were computed", expected));
  };
  require("E in [materials.aggregate]", scene.materials.rock_modulus.value_or(0), network.rock_modulus);
  require("poisson_ratio in [materials.mastic]", scene.materials.mastic_poisson_ratio.value_or(0),
          network.mastic_poisson_ratio);
  if (network.rule == ContactRule::volumetric)
    require("poisson_ratio in [materials.aggregate]", scene.materials.aggregate_poisson_ratio.value_or(0),
            network.rock_poisson_ratio);
}

/// Refuses a given specimen if its strips or rollers, or its size between them, are not those of the scene. \throws
/// InputError
void require_same_domain(const Scene& scene, const Specimen& specimen) {
  const Domain &expected = scene.specimen.box, &found = specimen.box;
  const auto strips = [](const Domain& d) {
    const auto* disc = std::get_if<domains::Disc>(&d.shape);
    return disc ? disc->strip_width : 0;
  };
  const auto rollers = [](const Domain& d) { return d.rollers() ? *d.rollers() : domains::Rollers{}; };
  const bool has_parts = strips(expected) > 0 || strips(found) > 0 || expected.rollers() || found.rollers();
  if (!has_parts) return;
  const auto words = [&](const Domain& d) {
    std::string out = d.dimensions();
    if (strips(d) > 0) out += fmt::format(", strips of {:g} m", strips(d));
    const domains::Rollers of = rollers(d);
    if (of.width > 0)
      out += fmt::format(", {}rollers of {:g} m at x = {:g} m below and {:g} m above", of.turn ? "turning " : "",
                         of.width, fmt::join(of.bottom, ", "), fmt::join(of.top, ", "));
    return out == d.dimensions() ? out + ", no strips and no rollers" : out;
  };
  if (words(expected) != words(found))
    throw InputError(scene.file.string(), 0, "specimen", words(found), words(expected));
}

/// The course of one run. Each step returns its result or stores it in a member that no other step changes.
class SceneRun {
 public:
  SceneRun(Scene scene, const std::filesystem::path& out, const Watcher& watcher, bool resume, const RunParts& parts,
           const Preparation* given)
      : scene_(std::move(scene)), out_(out), watcher_(watcher), resume_(resume), parts_(parts), given_(given) {}

  /// Runs the scene. `about_scene`: warnings about the scene itself.
  RunResult run(const std::vector<std::string>& about_scene) {
    begin();
    if (!given_) made_ = make_preparation();
    if (given_) require_same_domain(scene_, given_->specimen);
    if (given_) require_same_rule(scene_, given_->network);
    if (given_) require_laws(scene_, given_->specimen, given_->network);
    if (given_) require_fracture_energies(scene_, given_->network);
    const Backend backend = wait_for_backend();
    const std::vector<std::string> warnings = checkpoint_warnings(backend);
    if (watcher_.prepared) watcher_.prepared(prepared());
    const std::vector<std::string> packing = packing_warnings(prepared().specimen, prepared().tessellation);
    if (watcher_.warn) std::ranges::for_each(packing, watcher_.warn);
    const std::vector<std::string> decisions = assign_devices(backend);
    Planned planned = plan(backend);
    RunResult result = std::move(planned.result);
    result.phases.start += start_.start;
    const auto append = [](std::vector<std::string>& list, const std::vector<std::string>& more) {
      list.insert(list.end(), more.begin(), more.end());
    };
    append(result.decisions, decisions);
    if (const std::string words = words_of_air_voids(scene_); !words.empty()) result.decisions.push_back(words);
    if (scene_.mastic_source) result.decisions.push_back(words_of(*scene_.mastic_source));
    if (prepared().rock)
      result.decisions.push_back(words_of(*prepared().rock, prepared().specimen, scene_.network.rule));
    if (const auto error = model_error_of(scene_, prepared())) result.decisions.push_back(words_of(*error));
    append(result.warnings, about_scene);
    append(result.warnings, warnings);
    append(result.warnings, packing);
    if (scene_.network.lateral_walls) {
      result.warnings.emplace_back(
          "the sides are held, so the moduli are confined moduli, not |E*| or E(t) of a specimen with free sides");
    }
    write_specimen(result.phases);
    solve(planned, result);
    if (is_stepped()) remove_own_checkpoint(out_, scene_, result.backend, planned.solution->owns_checkpoint());
    return result;
  }

 private:
  const Preparation& prepared() const { return given_ ? *given_ : *made_; }
  bool is_stepped() const { return macadam::is_stepped(scene_.solver.method); }

  /// Looks for the backend, locks the folder and reads the checkpoint.
  void begin() {
    const InPhase starting(start_, &PhaseSeconds::start);
    backend_.emplace(scene_, parts_.place ? std::chrono::milliseconds(0) : none_is_known_within);
    if (resume_) require_resumable(scene_);
    folder_.emplace(out_);
    if (!resume_) return;
    FoundCheckpoint found = find_checkpoint(out_, scene_, backend_->get());
    resumed_ = Resumed{std::move(found.checkpoint), found.file};
    damage_ = std::move(found.damage);
  }

  Preparation make_preparation() {
    const Progress look_too = [&](const std::string& stage, double share) {
      backend_->look();
      if (watcher_.progress) watcher_.progress(stage, share);
    };
    return parts_.prepare ? parts_.prepare(scene_, look_too) : prepare(scene_, look_too);
  }

  Backend wait_for_backend() {
    const InPhase waiting(start_, &PhaseSeconds::start);
    return backend_->get();
  }

  /// Checks that the checkpoint belongs to the specimen. If the newest checkpoint is damaged, the previous one takes
  /// its place. Returns the warnings for the result.
  std::vector<std::string> checkpoint_warnings(Backend backend) {
    const std::filesystem::path newest = out_ / checkpoint_name;
    if (!resume_ && is_stepped() && watcher_.warn && is_checkpoint_of(newest, scene_, backend)) {
      watcher_.warn(newest.string() +
                    ": an earlier run left this checkpoint; the run now starts from the beginning, and --resume would "
                    "have continued the earlier run");
    }
    if (resumed_) require_same_specimen(resumed_->file, resumed_->checkpoint, prepared());
    if (damage_.empty()) return {};
    std::error_code error;
    std::filesystem::rename(resumed_->file, newest, error);
    if (error)
      throw RunError(resumed_->file.string() + ": cannot be renamed to " + checkpoint_name + ": " + error.message());
    const std::string warning =
        "the run continues from the previous checkpoint, because the newest one is missing or damaged: " + damage_;
    if (watcher_.warn) watcher_.warn(warning);
    return {warning};
  }

  /// Chooses the devices of the scene, if its backend is cuda. Returns the decisions about them.
  std::vector<std::string> assign_devices(Backend backend) {
    if (backend != Backend::cuda) return {};
    std::string decision;
    if (parts_.place) {
      parts_.place(scene_.solver);
    } else if (scene_.solver.method == SolverMethod::explicit_ && scene_.solver.devices.empty()) {
      scene_.solver.devices = choose_devices(prepared().network.contacts.size(), decision);
    }
    return decision.empty() ? std::vector<std::string>{} : std::vector{decision};
  }

  /// Plans the experiment. If the experiment cannot be solved and the folder has no older results, the plan of the
  /// experiment is returned all the same. The specimen is then written, and the user can look at it.
  Planned plan(Backend backend) {
    try {
      Planned out = plan_experiment(scene_, prepared(), watcher_, std::move(resumed_), backend);
      if (out.unsolvable && std::filesystem::exists(out_ / "summary.json")) std::rethrow_exception(out.unsolvable);
      return out;
    } catch (const InterruptedError&) {
      throw InterruptedError(
          "interrupted while planning; nothing was written, and the files in the folder are unchanged");
    }
  }

  /// Replaces older results by the files of the specimen.
  void write_specimen(PhaseSeconds& phases) const {
    // an interruption up to this point leaves the folder unchanged
    if (watcher_.progress) watcher_.progress("writing the specimen", 0);
    const InPhase writing(phases, &PhaseSeconds::writing);
    write_preparation(scene_, prepared(), out_, [&] {
      remove_results(out_);
      if (!resume_) remove_fields(out_);
    });
  }

  /// Runs the experiment and saves summary.json, also after an error.
  void solve(const Planned& planned, RunResult& result) const {
    const Saving save = [&](const std::string& status) {
      const InPhase writing(result.phases, &PhaseSeconds::writing);
      write_whole(out_ / "summary.json", summary_json(scene_, prepared(), result, status));
    };
    try {
      if (planned.unsolvable) std::rethrow_exception(planned.unsolvable);
      if (watcher_.planned) watcher_.planned(result);
      planned.solution->solve(out_, SparingSave(save), result);
    } catch (const std::exception& error) {
      try {
        save(status_of(error));
      } catch (
          const std::exception&) {  // a full disk may be the reason for the first error, which is the one to report
      }
      throw;
    }
    save("done");
  }

  Scene scene_;
  const std::filesystem::path& out_;
  const Watcher& watcher_;
  const bool resume_;
  const RunParts& parts_;
  const Preparation* const given_;
  PhaseSeconds start_;  ///< wall time before the planning
  std::optional<FoundBackend> backend_;
  std::optional<ResultFolder> folder_;
  std::optional<Resumed> resumed_;
  std::string damage_;  ///< fault of the newest checkpoint
  std::optional<Preparation> made_;
};

}  // namespace

RunResult run_scene(Scene scene, const std::filesystem::path& out, const Watcher& watcher, bool resume,
                    const RunParts& parts, const Preparation* given) {
  require_combination(scene);
  const ThreadLimit threads(scene.solver.threads);
  std::vector<std::string> warnings = compute_mastic_law(scene, watcher);
  for (const auto& more : {law_range_warnings(scene), scene.specimen.merged})
    warnings.insert(warnings.end(), more.begin(), more.end());
  if (watcher.warn) std::ranges::for_each(warnings, watcher.warn);
  return SceneRun(std::move(scene), out, watcher, resume, parts, given).run(warnings);
}

}  // namespace macadam
