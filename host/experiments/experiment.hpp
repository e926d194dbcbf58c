// SPDX-License-Identifier: GPL-3.0-or-later
/// \file experiment.hpp  What a test of the list in macadam/experiments/all.hpp gives to all that tests have in common.
/// Each test defines its own in host/experiments/<kind>/, as specialisations of these.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/scene/table.hpp"
#include "host/simulation/solution.hpp"

namespace macadam {

/// Of what a scene asks for.
template <class Spec>
struct ExperimentOf {
  /// Reads `[loading]`. \throws InputError
  static Spec read(const scene::Section& loading);

  /// Makes ready what finds the answer without stepping in time. What refuses the scene does so here, before a file is
  /// touched. Scene, preparation and watcher must outlive it. \throws InputError, RunError
  static std::unique_ptr<Solution> plan(const Spec& spec, const Scene& scene, const Preparation& prepared,
                                        const Watcher& watcher, RunResult& result);
};

/// Of what was found.
template <class Result>
struct ResultOf {
  /// The entry of `results` in summary.json.
  static nlohmann::ordered_json summary(const Result& result, const Scene& scene);

  /// What the command says at its end: lines for people.
  static std::string table(const Result& result);
};

/// By the scene's test.
std::unique_ptr<Solution> plan_without_steps(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                             RunResult& result);

/// Files of results that a run of any test may leave in its folder, summary.json and contacts.csv too.
std::vector<std::string> result_files();

}  // namespace macadam
