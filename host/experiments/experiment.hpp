// SPDX-License-Identifier: GPL-3.0-or-later
/// \file experiment.hpp  What a test of the list in macadam/experiments/all.hpp gives to all that tests have in common.
/// Each test defines its own in host/experiments/<kind>/, as specialisations of these.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/results/checkpoint.hpp"
#include "host/scene/table.hpp"
#include "host/simulation/solution.hpp"

namespace macadam {

/// A checkpoint of the same scene and specimen, from which a stepped run goes on, and where it was found.
struct Resumed {
  Checkpoint checkpoint;
  std::filesystem::path file;
};

/// Of what a scene asks for.
template <class Spec>
struct ExperimentOf {
  /// Reads `[loading]`. \throws InputError
  static Spec read(const scene::Section& loading);

  /// Makes ready what finds the answer by the scene's method. What refuses the scene does so here, before a file is
  /// touched. Scene, preparation and watcher must outlive it. \throws InputError, RunError
  static std::unique_ptr<Solution> plan(const Spec& spec, const Scene& scene, const Preparation& prepared,
                                        const Watcher& watcher, std::optional<Resumed> resumed, RunResult& result);

  /// Returns the files of results that a run of the scene leaves by its method and output, besides those of every run.
  static std::vector<std::string> files(const Spec& spec, const Scene& scene);
};

/// Of what was found.
template <class Result>
struct ResultOf {
  /// Adds its entries to `results` of summary.json, and to `solver` what it has to say of that.
  static void summarise(const Result& found, const Scene& scene, const RunResult& run, nlohmann::ordered_json& out);

  /// Wall time until it was found, of all processes of a resumed run [s].
  static double seconds(const Result& found);

  /// What the command says at its end: lines for people.
  static std::string table(const Result& found);
};

/// By the scene's test.
std::unique_ptr<Solution> plan_experiment(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                          std::optional<Resumed> resumed, RunResult& result);

/// By the scene's test.
std::vector<std::string> files_written(const Scene& scene);

/// By the result's test. A run that has found nothing says what a stepped one would.
void summarise(const Scene& scene, const RunResult& result, nlohmann::ordered_json& out);

/// `solve` of `timing_s` in summary.json: what was found, with what prepares the solutions.
double solve_seconds(const RunResult& result);

/// Files of results that a run of any test may leave in its folder, summary.json and contacts.csv too.
std::vector<std::string> result_files();

}  // namespace macadam
