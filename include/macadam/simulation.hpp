// SPDX-License-Identifier: GPL-3.0-or-later
/// \file simulation.hpp  Runs a scene and writes its results to a folder, which is the main job of the library.
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

/// Rock and air in the cells of a specimen whose contacts follow the rule "series", beside their nominal amounts. All
/// fractions are of the volume of the box.
struct RockReport {
  double rock_cells = 0;               ///< cells of aggregates
  std::optional<double> rock_nominal;  ///< true aggregates; empty if their volumes are unknown
  double void_cells = 0, void_nominal = 0;
  std::int64_t mastic_centres_in_rock = 0;  ///< number of mastic spheres whose centres lie in aggregates
};

/// Particles, cells and contacts of a scene, and the wall time in which they were made.
struct Preparation {
  Specimen specimen;
  std::vector<CompositionRow> composition;  ///< empty for a specimen read from a file, as is `aggregates`
  std::vector<Aggregate> aggregates;
  std::optional<RockReport> rock;  ///< with rule "series"
  Tessellation tessellation;
  ContactNetwork network;
  std::int64_t loose_particles = 0;  ///< particles in clusters that do not touch both walls; they carry no load
  int spanning_clusters = 0;         ///< clusters that touch both walls; 1 in a domain without them
  int relaxation_iterations = 0;     ///< iterations of the generator; generated specimens only
  double seconds_specimen = 0, seconds_tessellation = 0, seconds_network = 0;
};

/// Something that a run leaves out because the scene does not need it.
struct Skip {
  std::string what, why;
  std::string effect;  ///< effect on the result: "none: same bits", or its size
};

/// Wall time of the phases of a run in this process [s], in addition to the times in the run's Preparation. Every
/// moment belongs to exactly one phase.
struct PhaseSeconds {
  double start = 0;           ///< finding a device and waiting for it, reading a checkpoint
  double planning = 0;        ///< explicit: critical step and settings
  double preconditioner = 0;  ///< making the preconditioner or the factorisation for harmonic solutions
  double harmonic = 0;        ///< harmonic solutions: for the plan, for a steady start, or as the result of the run
  double stepper = 0;         ///< explicit: making the steppers and their states
  double stepping = 0;        ///< explicit: the steps, including response.csv, which grows by one line per sample
  double writing = 0;         ///< all other files

  double sum() const { return start + planning + preconditioner + harmonic + stepper + stepping + writing; }
};

/// Result of a run.
struct RunResult {
  ExperimentResult found;              ///< result of the scene's experiment
  PhaseSeconds phases;                 ///< the time of a phase is added when the phase has ended
  std::vector<std::string> decisions;  ///< choices that the scene left open, and the reason for each
  std::vector<Skip> skips;
  std::vector<std::string> warnings;  ///< warnings for the reader of the results, one sentence each
  std::string solver;  ///< description of the solver that ran: Stepper::description(), or "harmonic, …"
  Backend backend = Backend::automatic;  ///< the backend that ran

  /// Return the result of a cyclic test: stepped() if it was stepped in time, harmonic() if it was solved in
  /// the frequency domain. \throws std::bad_variant_access if the run had another result.
  const experiments::SteppedCyclic& stepped() const { return std::get<experiments::SteppedCyclic>(found); }
  const experiments::HarmonicCyclic& harmonic() const { return std::get<experiments::HarmonicCyclic>(found); }
};

/// A function that is called as work proceeds, with the name of the current stage and the fraction of this stage that
/// is done, 0…1. An exception thrown by it ends the work.
using Progress = std::function<void(const std::string& stage, double share)>;

/// Returns the results of a run as lines of text to be printed.
std::string results_table(const RunResult& result);

/// Makes specimen (reads or generates it), tessellation and network; checks that every pair that is present has a law.
Preparation prepare(const Scene& scene, const Progress& progress = {});
/// Prepares a scene as above, but with the given particles in place of the scene's own.
Preparation prepare(const Scene& scene, Specimen specimen, const Progress& progress = {});

/// Prepares a scene and writes specimen.csv, aggregates.csv (generated specimens), gradation.csv (recipes by mass),
/// contacts.csv (if the scene asks for it), section_*.csv of the cross-sections, and summary.json without results.
/// Nothing is written before the work is done.
///
/// \throws InputError also if the folder holds a run, whose results these files would replace, or if another command
/// is writing into it; RunError.
Preparation prepare_into(const std::filesystem::path& out, const Scene& scene,
                         const std::vector<SectionPlane>& sections = {}, const Progress& progress = {});

/// Functions that a run calls as it proceeds; any may be empty.
struct Watcher {
  Progress progress;
  std::function<void(const Preparation&)> prepared;  ///< called once specimen and network are made
  /// Called with the decisions, before the first step. The scene has then been accepted and the specimen's files are
  /// written.
  std::function<void(const RunResult&)> planned;
  /// Called at once for each warning. RunResult::warnings also has all warnings.
  std::function<void(const std::string&)> warn;
  /// Called before the first sample, at least once per second while steps are taken, and between iterations of the
  /// frequency domain. If it returns true, the run ends; a stepped run leaves a checkpoint.
  std::function<bool()> stop;
  /// Called before the steps of each frequency of a cyclic test on backend cuda, with the number of steps that the test
  /// still has to take, including the steps of this frequency. Returns the devices that take the steps. An empty list
  /// means the devices of the previous frequency or, for the first frequency, the devices of the scene. If the steps
  /// cannot be taken on another device, the previous device continues, and this function is not called again. The
  /// results have the same bits on any device.
  std::function<DeviceList(std::int64_t steps)> devices;
  /// Called after every `every` steps of a stepped test, with the frequency of a cyclic test, otherwise with 0. `every`
  /// = 0: never.
  std::function<void(const Stepper&, double frequency_hz)> stepped;
  std::int64_t every = 0;
};

/// Computes the law of the mastic, if the scene takes it from the specimen of another scene (Scene::mastic_source); for
/// other scenes does nothing. The specimen is solved in the frequency domain over the reduced frequencies that the test
/// of `scene` needs, and a chain of at most 16 Kelvin units that approximates the modulus of the specimen becomes the
/// law of the mastic, with the specimen's temperature shift. The result is stored in a folder next to the other scene,
/// named by a digest of that scene's content, so that it need not be computed again. run() and calibrate() call this
/// function; callers that use Scene::laws by themselves must call it first. Returns the warnings about the other scene.
///
/// \throws InputError, RunError with a message that names both scenes; InterruptedError.
std::vector<std::string> compute_mastic_law(Scene& scene, const Watcher& watcher = {});

/// Does the whole job: prepares the scene, plans the run, computes the results and writes every file. The folder is not
/// changed until preparing and planning are done, so a scene that is refused leaves older results unchanged. After
/// planning, older results are replaced.
///
/// At any time response.csv is complete up to the last sample, and summary.json up to the last frequency. (If a
/// frequency takes less than ten times as long as saving, summary.json is saved less often, so that saving takes at
/// most about a tenth of the time.)
///
/// A stepped run of a scene that was read from a file writes `checkpoint.h5` as it goes (OutputSpec::checkpoint). The
/// file is replaced by renaming, and the previous checkpoint is kept as `checkpoint-previous.h5`. A checkpoint that
/// cannot be written causes a warning. At the end the run removes its own checkpoints and older checkpoints of the same
/// scene, but no other checkpoints. The first checkpoint of a run replaces any checkpoint that is already in the
/// folder. Backend reference writes no checkpoints.
///
/// With `resume`, the run continues from the checkpoint. Its results have the same bits as the results of a run that
/// was never interrupted. If the newest checkpoint is missing or damaged, there is a warning, and the run continues
/// from the previous one.
///
/// \throws InputError also for a checkpoint that is missing, damaged, or of another scene, version, backend or
/// precision, and if another command is writing into the folder; InterruptedError; RunError (DivergenceError names
/// particle and time), also if the scene has a tolerance and a result cannot be right.
///
/// All processes that join_ranks() has joined must call this with the same scene; the first process writes the results.
/// If `watcher` calls functions of a stepper, it must call them in all processes. If one process fails, the others wait
/// for it until it calls Ranks::end_all().
RunResult run(const Scene& scene, const std::filesystem::path& out, const Watcher& watcher = {}, bool resume = false);
/// Runs a scene as above with an existing preparation, of this scene or of another scene with the same particles.
RunResult run(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out,
              const Watcher& watcher = {}, bool resume = false);

}  // namespace macadam
