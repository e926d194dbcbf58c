// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_test.hpp  What relaxation, creep and constant rates have in common: a load of the top wall as time goes
/// on, and what answers it at some times.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/experiments/experiment.hpp"
#include "host/experiments/material_solution.hpp"
#include "macadam/drives/drive.hpp"

namespace macadam {

/// When a load grows and goes.
struct LoadTimes {
  double ramp = 0;                ///< time in which the load grows, and in which it goes [s]; 0: at once
  std::optional<double> release;  ///< when it begins to go [s]; nothing: never
};

/// One of these tests, as both methods read it.
struct LoadTest {
  std::string kind;
  History history;
  double poisson_ratio = 0;
  std::vector<std::pair<const char*, std::optional<double>>> load;  ///< what was asked, as summary.json names it
  /// Returns the answer at a time from the specimen's spectrum, to this load with these times.
  std::function<experiments::ResponsePoint(const Spectrum&, double time, const LoadTimes& when)> unstepped;

  bool by_stress = false;             ///< the load is a stress; else a strain
  LoadTimes when;                     ///< as the scene has them
  bool grows = false;                 ///< all the time: then the ramp is the whole test
  std::optional<double> platen_mass;  ///< of a wall under a stress [kg]
  std::optional<double> strain;       ///< the largest, where it is known beforehand
  double held_stress = 0;             ///< of a load that is a stress [Pa]
  /// The load [m] or [N] in steps; `unit`: that of a strain or a stress of 1. `ramp` is that of this run.
  std::function<std::shared_ptr<const Drive>(double unit, double dt, double ramp)> drive;
};

/// As a kind's own folder has it.
/// @{
LoadTest load_test(const experiments::Relaxation& spec);
LoadTest load_test(const experiments::Creep& spec);
LoadTest load_test(const experiments::Monotonic& spec);
/// @}
LoadTest load_test_of(const Scene& scene);

/// How a kind's numbers are called.
struct LoadWords {
  const char *kind, *file, *ratio;  ///< ratio: of ResponsePoint, in files
  const char* comment;              ///< in the file, without steps
  bool stress_first;                ///< the load's column comes before the answer's
  const char* shown;                ///< the ratio for people, and its unit
  const char* shown_stepped;        ///< the same, of a stepped run: of the strain and stress of its row
  double unit;
};
const LoadWords& words_of(const std::string& kind);

/// A point in the kind's file, in summary.json and for people, with what stands above it.
/// @{
std::string csv_head(const LoadWords& words);
std::string csv_line(const LoadWords& words, const experiments::ResponsePoint& point);
nlohmann::ordered_json point_json(const LoadWords& words, const experiments::ResponsePoint& point);
std::string shown_head(const char* ratio);
std::string shown_line(const LoadWords& words, const char* ratio, const experiments::ResponsePoint& point);
/// @}

/// What was asked, into an entry of `results`.
void add_load(const LoadTest& test, nlohmann::ordered_json& out);

/// The files of results of a kind by the scene's method: its table, and without steps the tables of the material.
std::vector<std::string> load_files(const std::string& kind, const Scene& scene);

/// By the scene's method: from the spectrum, or in steps. \throws InputError, RunError as either does.
std::unique_ptr<Solution> plan_load_test(const LoadTest& test, const Scene& scene, const Preparation& prepared,
                                         const Watcher& watcher, std::optional<Resumed> resumed, RunResult& result);

}  // namespace macadam
