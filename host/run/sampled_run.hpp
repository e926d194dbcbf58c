// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sampled_run.hpp  Runs a stepper (the object that takes the time steps) from sample to sample. All
/// experiments that are stepped in time use this file.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "host/fields/field_output.hpp"
#include "host/run/checkpoints.hpp"
#include "macadam/simulation.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

using Clock = std::chrono::steady_clock;
inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Describes one run in time: at which steps it is sampled, and the functions that are called there.
struct Course {
  std::string name;                  ///< name in messages: "20 Hz", "creep"
  double dt = 0;                     ///< [s]
  double frequency = 0;              ///< [Hz], of a cyclic test
  std::int64_t first = 0, last = 0;  ///< numbers of the first and last sample; sample 0 is at step 0
  /// The step of a sample; it never decreases from sample to sample.
  std::function<std::int64_t(std::int64_t)> step_of;
  std::function<bool(std::int64_t)> taken;  ///< whether this sample is passed to `take`
  /// Receives a sample. Unless uses_stepper(sample), the stepper may already be beyond the step of this sample.
  std::function<void(std::int64_t sample, const Observation& now)> take;
  /// Returns whether `take` uses the stepper at this sample; the stepper is then still at the sample. Empty: never.
  std::function<bool(std::int64_t)> uses_stepper = {};
  std::function<bool()> ended = {};  ///< called after `take`: returns whether this sample is the last; may be empty
  /// Called after every `between_every` steps, if this number is not 0. These steps may lie between samples. A resumed
  /// run may call it a second time for the step from which it continues.
  std::function<void(const Observation& now)> between = {};
  std::int64_t between_every = 0;
  std::function<std::string(std::int64_t step, double steps_a_second)>
      shown;        ///< returns a text about the progress, to be printed
  Content content;  ///< contents of a checkpoint, without the stepper's state
  /// Called after the first seconds with the predicted remaining time [s]. May be empty.
  std::function<void(double seconds)> report_remaining = {};
};

/// Runs the courses of an experiment, which share a checkpoint and the field output.
class SampledRuns {
 public:
  /// `resumed`: the checkpoint in the folder belongs to this run. All arguments except the path must outlive this
  /// object. \throws RunError
  SampledRuns(const Scene& scene, const Preparation& prepared, const Watcher& watcher, RunResult& result,
              const std::filesystem::path& out, bool resumed, std::function<void(const std::string&)> warn);

  /// Begins or continues the series of fields of a course. `samples`: number of samples per period of a cyclic test, or
  /// of the whole test otherwise.
  void begin_fields(const std::string& name, int samples, double time);

  /// Takes the steps from the stepper's current step to the last sample. If the course ends early, a frame of its last
  /// sample is written. Between steps, this function checks whether a checkpoint is due or the run must stop. This
  /// check precedes the sample at the current step. The results have the same bits wherever a run is interrupted and
  /// resumed. \throws DivergenceError naming the particle that first left the plausible range; InterruptedError;
  /// RunError.
  void run(Stepper& stepper, const Course& course, ContactForm form, Geometry geometry);

  /// Checks at the stepper's current step whether a checkpoint is due or the run must stop. \throws InterruptedError
  void look(const Stepper& stepper, const Course& course);

  /// Returns whether the checkpoint in the folder, if there is one, belongs to this run.
  bool own_checkpoint() const { return checkpoints_.own(); }

 private:
  const Watcher& watcher_;
  RunResult& result_;
  std::function<void(const std::string&)> warn_;
  Checkpoints checkpoints_;
  FieldOutput fields_;
};

}  // namespace macadam
