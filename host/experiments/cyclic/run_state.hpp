// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_state.hpp  Stores the state of a stepped cyclic test in a checkpoint, and reads it back.
#pragma once

#include <string>
#include <vector>

#include "host/experiments/cyclic/plan.hpp"
#include "host/run/checkpoints.hpp"

namespace macadam {

/// Broken contact points of one frequency.
struct FrequencyCracks {
  std::vector<experiments::CrackEvent> events;
  std::optional<experiments::Rupture> rupture;  ///< the reason if the steps of this frequency ended early
  double time_s = 0, strain = 0;                ///< at the last sample at which broken points were counted
};

/// Everything that a stepped run needs to continue, with results that have the same bits. The results of finished
/// frequencies are not stored: they are computed again from plan and samples.
struct RunState {
  Plan plan;  ///< a resumed run does not need the harmonic solutions from which the plan was made
  double seconds_planning = 0;
  std::vector<double> seconds;                      ///< wall time of each finished frequency
  double seconds_running = 0;                       ///< wall time of the running frequency until now
  std::vector<std::string> warnings;                ///< warnings about checkpoints that could not be written
  std::vector<ResponseSample> samples;              ///< samples of all frequencies until now
  std::vector<FrequencyCracks> cracks;              ///< one entry per frequency of the plan; empty if it has not begun
  std::vector<experiments::Increments> increments;  ///< of each finished frequency; method "quasi_static"
  std::vector<StateArray> state;  ///< Stepper::state() of the running frequency; set only when read from a checkpoint
};

/// Returns the state in a checkpoint. \throws InputError, naming `file`, if it is damaged.
RunState to_run_state(Checkpoint checkpoint, const std::filesystem::path& file);

/// Adds everything except the stepper's state to a checkpoint.
void add_to(Checkpoint& checkpoint, const RunState& at, double seconds_running);

}  // namespace macadam
