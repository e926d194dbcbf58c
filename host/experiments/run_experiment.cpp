// SPDX-License-Identifier: GPL-3.0-or-later
// run_experiment.cpp  Runs the experiment of a scene and reports its result. Finds the functions of the experiment
// in the list of all experiments (macadam/experiments/all.hpp).
#include "host/experiments/experiment.hpp"

#include <stdexcept>

#include "host/files/result_files.hpp"
#include "macadam/error.hpp"

namespace macadam {

Planned plan_experiment(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                        std::optional<Resumed> resumed, Backend backend) {
  if (scene.mastic_source && !scene.mastic_source->computed)
    throw std::logic_error("the law of the mastic is provisional: compute_mastic_law() has not been called");
  Planned out;
  out.result.backend = backend;
  try {
    out.solution = std::visit(
        [&]<class Spec>(const Spec& spec) {
          return ExperimentOf<Spec>::plan(spec, scene, prepared, watcher, std::move(resumed), out.result);
        },
        scene.experiment);
  } catch (const InterruptedError&) { throw; } catch (const RunError&) {
    out.unsolvable = std::current_exception();
  }
  return out;
}

namespace {

/// Returns f(result), or `nothing` without a result.
template <class T, class F>
T of_found(const ExperimentResult& found, T nothing, F&& f) {
  return std::visit(
      [&]<class Result>(const Result& result) -> T {
        if constexpr (std::is_same_v<Result, std::monostate>)
          return nothing;
        else
          return f(result);
      },
      found);
}

}  // namespace

void summarise(const Scene& scene, const RunResult& result, nlohmann::ordered_json& out) {
  const bool nothing = std::holds_alternative<std::monostate>(result.found);
  const bool cyclic = std::holds_alternative<experiments::Cyclic>(scene.experiment);
  const ExperimentResult none =
      cyclic ? ExperimentResult(experiments::SteppedCyclic{}) : ExperimentResult(experiments::SteppedResponse{});
  const bool shown = nothing && is_stepped(scene.solver.method);
  of_found(shown ? none : result.found, 0, [&]<class Result>(const Result& found) {
    ResultOf<Result>::summarise(found, scene, result, out);
    return 0;
  });
}

double solve_seconds(const RunResult& result) {
  const double found =
      of_found(result.found, 0.0, []<class Result>(const Result& f) { return ResultOf<Result>::seconds(f); });
  const bool stepped = of_found(
      result.found, false, []<class Result>(const Result&) { return std::is_base_of_v<experiments::Stepped, Result>; });
  // The seconds of a stepped run include the planning of the run, and with it the making of the preconditioner. The
  // seconds of a frequency-domain solution do not include the preconditioner, so its time is added.
  return found + (stepped ? 0 : result.phases.preconditioner);
}

std::string results_table(const RunResult& result) {
  return of_found(result.found, std::string(),
                  []<class Result>(const Result& found) { return ResultOf<Result>::table(found); });
}

std::vector<std::string> files_written(const Scene& scene) {
  return std::visit([&]<class Spec>(const Spec& spec) { return ExperimentOf<Spec>::files(spec, scene); },
                    scene.experiment);
}

std::vector<std::string> files_of_run(const Scene& scene, bool aggregates) {
  std::vector<std::string> out = {"summary.json", "specimen.csv"};
  if (aggregates) out.emplace_back("aggregates.csv");
  if (scene.recipe) out.emplace_back("gradation.csv");
  for (std::string& name : files_written(scene)) out.push_back(std::move(name));
  if (scene.output.contacts) out.emplace_back("contacts.csv");
  if (!scene.changes.empty()) out.emplace_back(changed_scene_file);
  return out;
}

}  // namespace macadam
