// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepped_load.hpp  Declares a stepped test with a load on the top wall, from its planning to its results.
/// step_load.cpp makes the stepper and writes the files, load_samples.cpp takes the samples.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/experiments/transient/load_state.hpp"
#include "host/experiments/transient/stepped_columns.hpp"
#include "host/network/free_sides.hpp"
#include "host/quasi_static/quasi_static_stepper.hpp"
#include "host/run/cracks.hpp"
#include "host/run/planned_experiment.hpp"
#include "host/run/sampled_run.hpp"

namespace macadam {

/// A stepped test of a load, from its planning to its results.
class SteppedLoad : public PlannedExperiment {
 public:
  /// The scene, the preparation and the watcher must outlive this object. `at`: plan and progress; `resumed`: it is
  /// from a checkpoint.
  SteppedLoad(const TransientExperiment& test, const Scene& scene, const Preparation& prepared, const Watcher& watcher,
              Inertia inertia, LoadState at, bool resumed);

  /// Makes the stepper. The stepper is made before any file is changed, so that all files stay as they were if the
  /// stepper refuses the scene.
  void make(RunResult& result, const std::filesystem::path& checkpoint);

  /// Fills in the results that are known before the first step.
  void begin(RunResult& result);

  /// Warns of a run with very many steps.
  void warn_of_many_steps() const;

  void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) override;

  bool owns_checkpoint() const override { return owns_checkpoint_; }

 private:
  /// Gives the particles the velocities of a uniform strain rate: zero at the bottom wall, and the velocity of the top
  /// wall at the top.
  void set_in_motion();
  bool is_quasi_static() const { return scene_.solver.method == SolverMethod::quasi_static; }
  void make_quasi_static(const Boundary& boundary, const std::vector<StateArray>& state, Backend backend);

  std::string head(const LoadWords& words) const;
  std::string line(const LoadWords& words, const experiments::SteppedPoint& p) const {
    return csv_line(words, p) + "," + columns().line(p);
  }
  SteppedColumns columns() const;

  /// Returns whether the largest stress is recorded: only in a strength test, in which the strain grows and contact
  /// points can break.
  bool measures_peak() const { return cracks_.active() && test_.grows && !test_.by_stress && !test_.reverses; }
  /// Keeps the largest stress so far, with its time and strain; if the specimen cools, the largest tensile stress.
  void follow_peak(const Observation& now);

  /// Reads the state of the contacts at the stepper's present state, and returns the contact points that have broken
  /// since the last call. `time`: of this state [s].
  std::vector<experiments::CrackEvent> read_cracks(double time);

  /// Counts the contact points that are broken at a sample, sums the energies, and returns the events since the last
  /// sample. Under tension the test ends when no path of intact contacts joins the walls. In compression broken points
  /// still bear load, so the test goes on.
  std::vector<experiments::CrackEvent> look_for_cracks(experiments::SteppedPoint& point,
                                                       const ParticleState& particles);

  /// Returns the course of the run: its samples, and the functions that are called at them. Sample 0 is the initial
  /// state, which is drawn in the field files. The other samples are the points of the result.
  Course course_of(const std::function<void(experiments::SteppedPoint, const ParticleState&)>& add, Content content);

  /// Returns the point at the stepper's present step.
  experiments::SteppedPoint point(const Observation& now, const ParticleState& particles) const;

  /// Adds a warning if the error of a row is large. A specimen in two pieces has no equilibrium, so its rupture is
  /// reported instead of an error. In a strength test the rupture is a result and causes no warning.
  void judge(const experiments::SteppedResponse& found, std::vector<std::string>& warnings) const;

  const TransientExperiment test_;
  const Scene& scene_;
  const Preparation& prepared_;
  const Watcher& watcher_;
  Inertia inertia_;
  LoadState at_;
  LoadErrors errors_;
  std::shared_ptr<const Drive> drive_;
  std::unique_ptr<Stepper> stepper_;
  const QuasiStaticStepper* quasi_static_ = nullptr;  ///< `stepper_`, if the method is quasi-static
  std::optional<FreeSides> sides_;                    ///< empty if a side is held or has no cell
  CrackWatch cracks_;
  EnergyLedger ledger_;
  ContactState contact_state_;  // at the last point of the result; chains: see EnergyLedger::sample()
  std::optional<experiments::Rupture> rupture_ = {};
  std::optional<experiments::Peak> sudden_break_ = {};  ///< the last equilibrium, if the specimen then broke suddenly
  bool owns_checkpoint_;
};

}  // namespace macadam
