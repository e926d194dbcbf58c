// SPDX-License-Identifier: GPL-3.0-or-later
/// \file material_solution.hpp  Does the common part of relaxation, creep and constant-rate tests that are computed
/// without time steps: solves the relaxation spectrum of the specimen once.
#pragma once

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/scene/table.hpp"
#include "host/run/planned_experiment.hpp"
#include "macadam/experiments/material.hpp"

namespace macadam {

/// Returns what kind of modulus is computed, in words: confined or uniaxial.
const char* modulus_words(bool confined);

/// Times at which the response is requested, and times at which the load changes [s].
struct History {
  std::vector<double> times;
  /// A change of the load.
  struct Ramp {
    double begin, duration;
  };
  std::vector<Ramp> ramps;
  /// Shortest time in which the load changes much within a ramp [s]; infinite if no such time is shorter than the
  /// ramps.
  double shortest_change = std::numeric_limits<double>::infinity();

  /// Returns the shortest and the longest time after a change of the load at which the relaxation of the specimen must
  /// be known [s].
  std::pair<double, double> range() const;
};

/// A function that computes the response of an experiment from the material, writes the file of the experiment and
/// stores the response in `result`.
using Responds =
    std::function<void(const std::filesystem::path& out, experiments::Material material, RunResult& result)>;

/// Returns a solution that computes the spectrum for the times of a history, writes the tables of the material and
/// calls `responds`. \throws InputError if the scene has inertia, because a specimen with inertia has no relaxation
/// times; also as Harmonic does.
std::unique_ptr<PlannedExperiment> plan_material(const Scene& scene, const Preparation& prepared,
                                                 const Watcher& watcher, RunResult& result, const History& history,
                                                 double poisson_ratio, Responds responds);

/// Returns the entries about the material, with which `results` of summary.json begins for these experiments.
nlohmann::ordered_json material_json(const char* kind, const experiments::Material& material);

/// Returns the lines about the material, the last ones that the command prints.
std::string material_lines(const experiments::Material& material);

}  // namespace macadam
