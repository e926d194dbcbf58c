// SPDX-License-Identifier: GPL-3.0-or-later
/// \file material_solution.hpp  What relaxation and creep have in common: the specimen's spectrum, solved once.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "host/scene/table.hpp"
#include "host/simulation/solution.hpp"
#include "macadam/experiments/material.hpp"

namespace macadam {

/// What the moduli of a specimen are.
const char* modulus_words(bool confined);

/// When the load changes and when the answer is asked for [s].
struct History {
  std::vector<double> times;
  struct Ramp {
    double begin, duration;
  };
  std::vector<Ramp> ramps;

  /// From the shortest to the longest time after a change that the answers rest on.
  std::pair<double, double> range() const;
};

/// What a test makes of the material: it writes its file and puts its result into `result`.
using Responds =
    std::function<void(const std::filesystem::path& out, experiments::Material material, RunResult& result)>;

/// Solves the spectrum for what a history asks for, writes the tables of the material, and asks for the response.
/// \throws InputError for inertia, which has no relaxation times, and as Harmonic does.
std::unique_ptr<Solution> plan_material(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                        RunResult& result, const History& history, double poisson_ratio,
                                        Responds responds);

/// What all entries of `results` in summary.json begin with.
nlohmann::ordered_json material_json(const char* kind, const experiments::Material& material);

/// The last lines of what the command says.
std::string material_lines(const experiments::Material& material);

}  // namespace macadam
