// SPDX-License-Identifier: GPL-3.0-or-later
/// \file transient_experiment.hpp  Defines the common part of relaxation, creep, constant-rate tests and strain
/// histories: a load on the top wall that varies in time, and the response at some times.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// Times at which a load grows and is removed.
struct LoadTimes {
  double ramp = 0;                ///< time in which the load grows, and in which it is removed [s]; 0: at once
  std::optional<double> release;  ///< time at which the removal begins [s]; empty: never
};

/// Describes a relaxation, creep or constant-rate test, or a strain history. The same description is used for stepped
/// tests and for tests computed without time steps.
struct TransientExperiment {
  std::string kind;
  History history;
  double poisson_ratio = 0;
  TemperatureHistory temperature = {};  ///< of the specimen; empty: constant
  /// values that the scene requests, each with its name in summary.json
  std::vector<std::pair<const char*, std::optional<double>>> load;
  /// Returns the response at a time to this load, applied at the times `when`, from the specimen's relaxation spectrum.
  std::function<experiments::ResponsePoint(const Spectrum&, double time, const LoadTimes& when)> unstepped;

  bool by_stress = false;  ///< whether the load is a stress; otherwise it is a strain
  LoadTimes when;          ///< times as given in the scene
  /// Whether the load grows during the whole test; the ramp then lasts as long as the test.
  bool grows = false;
  /// Whether the load may pass through 0 (strain histories). Errors are then relative to the largest stress so far.
  bool reverses = false;
  /// Whether the top wall rests while the specimen cools. The result is then the largest tensile stress and its
  /// temperature, and the test ends when the specimen is in two pieces.
  bool cools = false;
  /// Times at which the rate of the load jumps, in addition to those that `when` gives [s], rising.
  std::vector<double> jumps;
  std::optional<double> platen_mass;  ///< mass of the top wall if a stress loads it [kg]
  std::optional<double> strain;       ///< the largest strain, if it is known beforehand
  double held_stress = 0;             ///< held stress, if the load is a stress [Pa]
  /// Returns the load as a drive, [m] or [N]. `unit`: the displacement at a strain of 1, or the force at a stress of 1
  /// Pa. `dt` and `ramp`: time step and ramp of the run.
  std::function<std::shared_ptr<const Drive>(double unit, double dt, double ramp)> drive;
  /// Returns a time step of at most `largest` [s] that divides the durations of the load. If this function is empty,
  /// the time step divides the ramp.
  std::function<double(double largest)> step = {};
  /// Meaning of strain and stress in a row, if the specimen is not a column under one stress. Rows then have
  /// displacement and load too.
  const char* rows = nullptr;
  /// Checksum of a load that is read from a file of its own; a run is resumed only with the same load.
  std::uint32_t checksum = 0;
};

/// Return the description of a test. Each function is defined in the source file of its test.
/// @{
TransientExperiment load_test(const experiments::Relaxation& spec);
TransientExperiment load_test(const experiments::Creep& spec);
TransientExperiment load_test(const experiments::Monotonic& spec);
TransientExperiment load_test(const experiments::StrainHistory& spec);
TransientExperiment load_test(const experiments::IndirectTensileStrength& spec);
TransientExperiment load_test(const experiments::SemicircularBending& spec);
TransientExperiment load_test(const experiments::ThreePointBending& spec);
TransientExperiment load_test(const experiments::Cooling& spec);
/// @}
/// Returns the description of the scene's experiment, or an empty one if the experiment is not a transient one.
TransientExperiment load_test_of(const Scene& scene);

/// Names and units of the numbers in the results of one kind of test.
struct LoadWords {
  const char *kind, *file;
  const char* ratio;    ///< the name of ResponsePoint::ratio in files; null if files have no such column
  const char* comment;  ///< comment in the file of a run without time steps
  bool stress_first;    ///< whether the column of the stress comes before the column of the strain
  const char* shown;    ///< name of the ratio in printed text, with its unit; null: not printed
  /// Name of the ratio in printed text for a stepped run, where the ratio is computed from strain and stress of a row.
  const char* shown_stepped;
  double unit;  ///< unit of the ratio in printed text
};
/// Returns the names and units for a kind of test. \throws RunError for a kind that is not a test of a load.
const LoadWords& load_words(const std::string& kind);

/// Return the text of a point of the result: for the file of this kind of test, for summary.json, and for the terminal.
/// The functions `…_head` return the header lines of the file and of the terminal's table.
/// @{
std::string csv_head(const LoadWords& words);
std::string csv_line(const LoadWords& words, const experiments::ResponsePoint& point);
nlohmann::ordered_json point_json(const LoadWords& words, const experiments::ResponsePoint& point);
std::string shown_head(const char* ratio);
std::string shown_line(const LoadWords& words, const char* ratio, const experiments::ResponsePoint& point);
/// @}

/// Adds the largest stress and the last stress of a strain history to an entry of `results`; adds nothing for other
/// kinds of test and before the first point. `points`: points of the result, in the order of their times.
template <class Point>
void add_extremes(const std::string& kind, const std::vector<Point>& points, nlohmann::ordered_json& out) {
  if (kind != experiments::StrainHistory::kind || points.empty()) return;
  const auto peak = std::max_element(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return std::abs(a.stress_pa) < std::abs(b.stress_pa);
  });
  out["peak_stress_pa"] = peak->stress_pa;
  out["peak_time_s"] = peak->time_s;
  out["final_stress_pa"] = points.back().stress_pa;
}

/// Adds the load that the scene requests to an entry of `results`.
void add_load(const TransientExperiment& test, nlohmann::ordered_json& out);

/// Returns the names of the result files of a kind of test: its table; the table of cracks if contact points can break;
/// the tables of the material if the test is computed without time steps.
std::vector<std::string> load_files(const std::string& kind, const Scene& scene);

/// Plans one test by the scene's method: from the relaxation spectrum, or in time steps. \throws InputError, RunError
/// as plan_material() and plan_load_steps() do.
std::unique_ptr<PlannedExperiment> plan_load_test(const TransientExperiment& test, const Scene& scene,
                                                  const Preparation& prepared, const Watcher& watcher,
                                                  std::optional<Resumed> resumed, RunResult& result);

}  // namespace macadam
