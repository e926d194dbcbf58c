// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cyclic_steps.hpp  Declares a stepped cyclic test, from its first stepper to its results.
/// step_frequencies.cpp takes the steps of one frequency after another, cyclic_samples.cpp takes the samples of a
/// frequency.
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/experiments/cyclic/increment_plan.hpp"
#include "host/experiments/cyclic/run_state.hpp"
#include "host/files/result_files.hpp"
#include "host/network/free_sides.hpp"
#include "host/run/cracks.hpp"
#include "host/run/planned_experiment.hpp"
#include "host/run/sampled_run.hpp"

namespace macadam {

/// A stepped cyclic test whose plan has been made.
class CyclicSteps : public PlannedExperiment {
 public:
  /// The scene, the preparation and the watcher must outlive this object. `at`: plan and progress; `resumed`: it is
  /// from a checkpoint.
  CyclicSteps(const Scene& scene, const Preparation& prepared, const Watcher& watcher, const Inertia& inertia,
              RunState at, bool resumed);

  /// Makes the first stepper. The stepper is made before any file is changed, so that all files stay as they were if
  /// the stepper refuses the scene.
  void make_first(RunResult& result, const std::filesystem::path& checkpoint);

  /// Fills in the results that are known before the first step, and the results of the frequencies that were finished
  /// when the checkpoint was written.
  void begin(RunResult& result);

  void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) override;

  bool owns_checkpoint() const override { return owns_checkpoint_; }

 private:
  void warn(const std::string& warning, RunResult& result);

  bool is_quasi_static() const;
  /// Makes the increments of a frequency.
  std::unique_ptr<Stepper> make_increments(std::size_t i, const std::vector<StateArray>& from, RunResult& result);
  /// Makes the stepper of a frequency. If there is a stepper of another frequency, reuses its data. At this point the
  /// run may move to other devices (GPUs).
  std::unique_ptr<Stepper> make(std::size_t i, const std::vector<StateArray>& from, RunResult& result);

  /// Begins to compute the steady start of a frequency in another thread, while a device takes the steps of the
  /// previous frequency.
  void begin_start(std::size_t i);
  StartState start_of(std::size_t i) const;

  void step(std::size_t i, LineWriter* writer, SampledRuns& sampled_runs, const Saving& save, RunResult& result);

  /// Creates cracks.csv if a law of the scene can break, and writes the events of a checkpoint into it.
  void begin_cracks(const std::filesystem::path& out);
  void write_cracks(std::size_t i, const std::vector<experiments::CrackEvent>& events);

  /// Counts the contact points that are broken at a sample of frequency i. If the top wall pulls and no path of intact
  /// contacts joins the walls, ends the steps of this frequency. In compression broken points still bear load, so the
  /// steps go on.
  void look_for_cracks(std::size_t i, CrackWatch& watch, const Observation& now);

  /// Warns of contact points that broke during a frequency, because the specimen then changed while its |E*| was
  /// measured.
  void warn_of_cracks(std::size_t i, const experiments::Cracks& found, RunResult& result);

  /// Returns the course of a frequency: its samples, and the functions that are called at them. Every sample is stored
  /// in `at_` and written at once. Without a writer, only the fitted cycles and the cycle before them are stored; the
  /// cycle before them is needed to compute the change from cycle to cycle.
  Course course_of(std::size_t i, LineWriter* writer, CrackWatch& cracks, const Content& content);

  /// Returns the lateral strain at the stepper's present step.
  double lateral_strain() const;

  void finish(std::size_t i, RunResult& result);

  const Scene& scene_;
  const Preparation& prepared_;
  const Watcher& watcher_;
  Inertia inertia_;
  RunState at_;
  DeviceList devices_;                              ///< devices of the stepper
  bool may_move_ = true;                            ///< whether the run may move to other devices
  const QuasiStaticStepper* increments_ = nullptr;  ///< `stepper_`, if the method is quasi-static
  std::unique_ptr<Stepper> stepper_;                ///< stepper of the running frequency or of the first one
  ContactState contact_state_;                      ///< at the last sample, if contact points can break
  bool used_ = false;                               ///< whether the stepper has run a frequency
  std::optional<FreeSides> sides_;                  ///< empty if a side is held or has no cell
  std::optional<LineWriter> cracks_writer_;
  std::size_t samples_read_ = 0;  ///< number of samples of finished frequencies
  bool owns_checkpoint_;
  /// Start of the next frequency; it is the last member, so that it is destroyed first, because its thread uses the
  /// other members.
  std::future<StartState> next_start_;
};

/// Returns the line of a sample in response.csv.
std::string response_line(const ResponseSample& sample);

}  // namespace macadam
