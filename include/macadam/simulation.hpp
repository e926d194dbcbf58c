// SPDX-License-Identifier: GPL-3.0-or-later
/// \file simulation.hpp  The main job: scene in, results in a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "macadam/cross_section.hpp"
#include "macadam/results.hpp"
#include "macadam/scene.hpp"
#include "macadam/sensitivity.hpp"
#include "macadam/specimen.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

class Stepper;

/// Particles, cells and contacts of a scene, with what their making took.
struct Preparation {
  Specimen specimen;
  std::vector<CompositionRow> composition;  ///< empty for specimens read from a file, likewise the next
  std::vector<Aggregate> aggregates;
  Tessellation tessellation;
  ContactNetwork network;
  std::int64_t loose_particles = 0;  ///< in clusters that do not touch both walls: they carry nothing
  int spanning_clusters = 0;         ///< clusters that touch both; one, usually
  int relaxation_iterations = 0;     ///< of a generated specimen
  double seconds_specimen = 0, seconds_tessellation = 0, seconds_network = 0;
};

/// Something that a run leaves out because the scene does not need it.
struct Skip {
  std::string what, why;
  std::string effect;  ///< on the answer: "none: same bits", or how much
};

/// Wall time of a run's phases in this process [s], beside those of its Preparation: each moment is in one of them.
struct PhaseSeconds {
  double start = 0;           ///< a device is found and waited for, a checkpoint is read
  double planning = 0;        ///< explicit: critical step and settings
  double preconditioner = 0;  ///< of the harmonic solutions, or their factors
  double harmonic = 0;        ///< harmonic solutions: for the plan, for the start, or those that are the result
  double stepper = 0;         ///< explicit: making the steppers and their states
  double stepping = 0;        ///< explicit: with response.csv, which grows by a line a sample
  double writing = 0;         ///< all other files

  double sum() const { return start + planning + preconditioner + harmonic + stepper + stepping + writing; }
};

/// Outcome of a run.
struct RunResult {
  ExperimentResult found;              ///< of the scene's test
  PhaseSeconds phases;                 ///< a phase is in it once it is over
  std::vector<std::string> decisions;  ///< what the scene left open, and what was chosen why
  std::vector<Skip> skips;
  std::vector<std::string> warnings;     ///< what a reader of the results must know, a sentence each
  std::string solver;                    ///< what ran, in words: Stepper::description(), or "harmonic, …"
  Backend backend = Backend::automatic;  ///< that ran

  /// The cyclic test as it was stepped, or as it was solved. \throws std::bad_variant_access where it was not.
  const experiments::SteppedCyclic& stepped() const { return std::get<experiments::SteppedCyclic>(found); }
  const experiments::HarmonicCyclic& harmonic() const { return std::get<experiments::HarmonicCyclic>(found); }
};

/// Called as work goes on: what is being done, share of it done 0…1. What it throws ends the work.
using Progress = std::function<void(const std::string& stage, double share)>;

/// What a run found, in lines for people.
std::string results_table(const RunResult& result);

/// Specimen (read or generated), tessellation, network; checks that every pair present has a law.
Preparation prepare(const Scene& scene, const Progress& progress = {});
/// The same of particles in place of the scene's own.
Preparation prepare(const Scene& scene, Specimen specimen, const Progress& progress = {});

/// Prepares a scene and writes specimen.csv, aggregates.csv (of a generated specimen), gradation.csv (of a recipe by
/// mass), contacts.csv (where the scene asks), section_*.csv of the planes and summary.json without results. Nothing is
/// written before the work is done.
/// \throws InputError also where the folder holds a run, whose results these files would replace, or where another
/// command is writing into it; RunError.
Preparation prepare_into(const std::filesystem::path& out, const Scene& scene,
                         const std::vector<SectionPlane>& sections = {}, const Progress& progress = {});

/// What a run tells as it goes; any may be empty.
struct Watcher {
  Progress progress;
  std::function<void(const Preparation&)> prepared;  ///< once specimen and network are there
  /// Decisions, once nothing can refuse the scene any more and the specimen's files are written: before the first step.
  std::function<void(const RunResult&)> planned;
  std::function<void(const std::string&)> warn;  ///< at once; all warnings are in RunResult::warnings too
  /// Asked before the first sample, once a second at least while steps are taken, and between iterations of the
  /// frequency domain: true ends the run, a stepped one with a checkpoint.
  std::function<bool()> stop;
  /// Asked before the steps of each frequency of a cyclic test on backend cuda, with the number of steps that are left,
  /// this frequency whole: the devices that take them. Where none is named, they are those of the frequency before, or
  /// the scene's. Where another device cannot take them, the one of before does, and this is asked no more. The bits
  /// are the same on any.
  std::function<DeviceList(std::int64_t steps)> devices;
  /// Called after every `every` steps of a test that is stepped, with the frequency of a cyclic one, else with 0;
  /// `every` = 0: never.
  std::function<void(const Stepper&, double frequency_hz)> stepped;
  std::int64_t every = 0;
};

/// The whole job: prepare, plan, step every frequency, write every file. The folder is as it was until preparing and
/// planning are done, so that what refuses the scene leaves older results alone; then they are replaced.
/// response.csv is complete up to the last sample whatever happens later; so is summary.json up to the last frequency
/// (up to ten times what saving takes, where frequencies take less). A stepped run of a scene that was read from a file
/// leaves `checkpoint.h5` as it goes (OutputSpec::checkpoint), replaced by a rename, and the one before it as
/// `checkpoint-previous.h5`; one that cannot be written is a warning. When all is done the run removes its own and
/// those of the same scene, no other; but its first one replaces whatever checkpoint is there. Backend reference keeps
/// none. `resume` goes on from it to the same bits as a run that was never interrupted; where the newest is missing or
/// damaged, a warning says so, and the one before is gone on from. \throws InputError also for a checkpoint that is not
/// there, damaged, or of another scene, version, backend or precision, and where another command is writing into the
/// folder; InterruptedError; RunError (DivergenceError names particle and time), also for a tolerance whose result
/// cannot be right.
///
/// Processes that join_ranks() has joined all call this with the same scene; the first has the files. What `watcher`
/// does with a stepper, it does on all of them. Where one fails, the others wait for it until Ranks::end_all().
RunResult run(const Scene& scene, const std::filesystem::path& out, const Watcher& watcher = {}, bool resume = false);
/// The same of what was prepared already, of this scene or of one with the same particles.
RunResult run(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out,
              const Watcher& watcher = {}, bool resume = false);

}  // namespace macadam
