// SPDX-License-Identifier: GPL-3.0-or-later
// experiment.cpp  What can be asked of any test, by the one list of them.
#include "host/experiments/experiment.hpp"

#include <fmt/format.h>

#include "host/scene/sections.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// f(an empty one) of every kind in the list.
template <class F>
void for_each_kind(F&& f) {
  [&]<std::size_t... kind>(std::index_sequence<kind...>) { (f(Experiment(std::in_place_index<kind>)), ...); }
  (std::make_index_sequence<std::variant_size_v<Experiment>>());
}

}  // namespace

Experiment scene::read_experiment(const Section& section) {
  std::vector<Experiment> kinds;
  std::vector<std::string> names;
  for_each_kind([&](const Experiment& experiment) {
    kinds.push_back(experiment);
    names.emplace_back(kind_of(experiment));
  });
  const auto kind = section.find("kind");  // without it, the first says that it is missing
  return std::visit([&]<class Spec>(const Spec&) -> Experiment { return ExperimentOf<Spec>::read(section); },
                    kinds[kind ? kind->choice(names) : 0]);
}

const char* kind_of(const Experiment& experiment) {
  return std::visit([](const auto& spec) { return spec.kind; }, experiment);
}

experiments::Stepping stepping_of(const Experiment& experiment) {
  return std::visit([](const auto& spec) { return spec.stepping; }, experiment);
}

std::vector<double> frequencies_of(const Experiment& experiment) {
  return std::visit(
      [](const auto& spec) -> std::vector<double> {
        if constexpr (requires { spec.frequencies; }) return spec.frequencies;
        return {};
      },
      experiment);
}

std::vector<double> temperatures_of(const Experiment& experiment) {
  return std::visit(
      [](const auto& spec) -> std::vector<double> {
        if constexpr (requires { spec.temperatures; }) return spec.temperatures;
        return {};
      },
      experiment);
}

bool has_fields(const Scene& scene) {
  return scene.solver.method == SolverMethod::explicit_ || !frequencies_of(scene.experiment).empty();
}

std::unique_ptr<Solution> plan_experiment(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                          std::optional<Resumed> resumed, RunResult& result) {
  return std::visit(
      [&]<class Spec>(const Spec& spec) {
        return ExperimentOf<Spec>::plan(spec, scene, prepared, watcher, std::move(resumed), result);
      },
      scene.experiment);
}

std::vector<std::string> files_of(const Experiment& experiment) {
  return std::visit([](const auto& spec) { return std::vector<std::string>(spec.files.begin(), spec.files.end()); },
                    experiment);
}

std::vector<std::string> result_files() {
  std::vector<std::string> out = {"contacts.csv", "summary.json"};
  for_each_kind([&](const Experiment& experiment) {
    for (const std::string& name : files_of(experiment)) out.push_back(name);
  });
  return out;
}

namespace {

/// f of what was found; `nothing` where nothing is.
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
  const bool shown = nothing && scene.solver.method == SolverMethod::explicit_;
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
  return found + (stepped ? 0 : result.phases.preconditioner);  // a stepped one has it in its planning
}

std::string results_table(const RunResult& result) {
  return of_found(result.found, std::string(),
                  []<class Result>(const Result& found) { return ResultOf<Result>::table(found); });
}

experiments::Cyclic& Scene::cyclic() { return const_cast<experiments::Cyclic&>(std::as_const(*this).cyclic()); }

const experiments::Cyclic& Scene::cyclic() const {
  if (const auto* found = std::get_if<experiments::Cyclic>(&experiment)) return *found;
  throw InputError(file.string(), 0, "kind in [loading]", kind_of(experiment), experiments::Cyclic::kind);
}

}  // namespace macadam
