// SPDX-License-Identifier: GPL-3.0-or-later
/// \file experiment.hpp  Declares the class templates ExperimentOf and ResultOf. Every experiment in the list of
/// macadam/experiments/all.hpp defines the functions of both templates for its own types, in a source file in
/// host/experiments/. The other functions of this file call the functions of the experiment that a scene names.
#pragma once

#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/files/checkpoint_file.hpp"
#include "host/scene/table.hpp"
#include "host/run/planned_experiment.hpp"

namespace macadam {

/// A checkpoint from which a stepped run of the same scene and specimen continues, and the file of the checkpoint.
struct Resumed {
  Checkpoint checkpoint;
  std::filesystem::path file;
};

/// Functions of an experiment. `Spec` is the type that describes the experiment in a scene.
template <class Spec>
struct ExperimentOf {
  /// Reads `[loading]`. \throws InputError
  static Spec read(const scene::Section& loading);

  /// Prepares the solution by the scene's method. All checks that can refuse the scene are made here, before any file
  /// is changed. Stores decisions, skips (parts of the computation that are left out) and warnings in `result`, which
  /// is empty except for the backend and may be moved to another address afterwards. Scene, preparation and watcher
  /// must outlive the solution. \throws InputError, RunError
  static std::unique_ptr<PlannedExperiment> plan(const Spec& spec, const Scene& scene, const Preparation& prepared,
                                                 const Watcher& watcher, std::optional<Resumed> resumed,
                                                 RunResult& result);

  /// Returns the names of the result files that a run of the scene writes, in addition to the files that every run
  /// writes.
  static std::vector<std::string> files(const Spec& spec, const Scene& scene);
};

/// Functions for the result of an experiment. `Result` is the type of the result.
template <class Result>
struct ResultOf {
  /// Adds the result to `results` of summary.json, and the settings of the solver to `solver` of summary.json.
  static void summarise(const Result& found, const Scene& scene, const RunResult& run, nlohmann::ordered_json& out);

  /// Returns the wall time until the result was found [s], of all processes of a resumed run.
  static double seconds(const Result& found);

  /// Returns the lines of text that the command prints when the run ends.
  static std::string table(const Result& found);
};

/// A planned experiment, and the part of its result that is known before it runs.
struct Planned {
  std::unique_ptr<PlannedExperiment> solution;
  RunResult result;               ///< decisions, skips, warnings and the wall time of the planning
  std::exception_ptr unsolvable;  ///< why the experiment cannot be solved; nullptr if it can
};

/// Calls `plan` of the scene's experiment. If `plan` throws a RunError, the error is returned as `unsolvable`, together
/// with the results that are known by then. \throws InputError, InterruptedError
Planned plan_experiment(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                        std::optional<Resumed> resumed, Backend backend);

/// Calls `files` of the scene's experiment.
std::vector<std::string> files_written(const Scene& scene);

/// Calls `summarise` of the result's experiment. For a stepped run that has no result yet, it is called with an empty
/// result.
void summarise(const Scene& scene, const RunResult& result, nlohmann::ordered_json& out);

/// Returns `solve` of `timing_s` in summary.json [s]: the time until the result was found, including the
/// preconditioner.
double solve_seconds(const RunResult& result);

/// Returns the names of all files that a run of the scene leaves in its folder, except field files and checkpoints.
/// `aggregates`: whether the specimen is generated and has aggregates.
std::vector<std::string> files_of_run(const Scene& scene, bool aggregates);

/// Returns the names of all result files that a run of any experiment may leave, including summary.json and
/// contacts.csv.
std::vector<std::string> result_files();

}  // namespace macadam
