// SPDX-License-Identifier: GPL-3.0-or-later
/// \file course.hpp  A stepper taken from sample to sample: what every test has in common that is stepped in time.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "host/fields/field_output.hpp"
#include "host/simulation/checkpoints.hpp"
#include "macadam/simulation.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

using Clock = std::chrono::steady_clock;
inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One run in time: at which steps it is looked at, and what is done there.
struct Course {
  std::string name;                                   ///< in messages: "20 Hz", "creep"
  double dt = 0;                                      ///< [s]
  double frequency = 0;                               ///< [Hz], of a cyclic test
  std::int64_t first = 0, last = 0;                   ///< numbers of samples; sample 0 is that of step 0
  std::function<std::int64_t(std::int64_t)> step_of;  ///< of a sample, never falling
  std::function<bool(std::int64_t)> taken;            ///< whether anybody wants this sample
  /// The stepper may have gone on from there.
  std::function<void(std::int64_t sample, const Observation& now)> take;
  bool looks_at_stepper = false;     ///< `take` does: it stands at the sample then
  std::function<bool()> ended = {};  ///< asked after `take`: whether this sample is the last. May be empty
  /// Called after every `between_every` steps, if that is not 0, also between samples. A resumed run may call it a
  /// second time for the step that it begins with.
  std::function<void(const Observation& now)> between = {};
  std::int64_t between_every = 0;
  std::function<std::string(std::int64_t step, double steps_a_second)> shown;  ///< how far it is, for people
  Content content;                                                             ///< of a checkpoint, but for the state
  /// After the first seconds: how many more it takes. May be empty.
  std::function<void(double seconds)> foretold = {};
};

/// What a test's courses share: its checkpoint and its fields.
class Courses {
 public:
  /// `resumed`: the checkpoint in the folder is this run's. All but the path must outlive it. \throws RunError
  Courses(const Scene& scene, const Preparation& prepared, const Watcher& watcher, RunResult& result,
          const std::filesystem::path& out, bool resumed, std::function<void(const std::string&)> warn);

  /// Begins or goes on with the series of fields of a course, of so many samples a piece (a period, the whole test).
  void begin_fields(const std::string& name, int samples, double time);

  /// From where the stepper stands to the last sample, of which a frame is written where the course ended early.
  /// Between steps it looks whether a checkpoint is due or the run is to stop, before the sample of the step that was
  /// reached is taken. The bits do not depend on where it was cut. \throws DivergenceError naming the particle that
  /// left the range of sense first; InterruptedError; RunError.
  void run(Stepper& stepper, const Course& course, ContactForm form, Geometry geometry);

  /// Whether the checkpoint, if it is there, is this run's.
  bool own_checkpoint() const { return checkpoints_.own(); }

 private:
  const Watcher& watcher_;
  RunResult& result_;
  std::function<void(const std::string&)> warn_;
  Checkpoints checkpoints_;
  FieldOutput fields_;
};

}  // namespace macadam
