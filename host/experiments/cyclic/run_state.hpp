// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_state.hpp  Where a stepped cyclic test stands, as a part of a checkpoint.
#pragma once

#include <string>
#include <vector>

#include "host/experiments/cyclic/plan.hpp"
#include "host/simulation/checkpoints.hpp"

namespace macadam {

/// All that a stepped run needs to go on to the same bits. The results of finished frequencies follow from plan and
/// samples.
struct RunState {
  Plan plan;  ///< decided once: the harmonic solutions that it rests on are not needed again
  double seconds_planning = 0;
  std::vector<double> seconds;          ///< wall time of each finished frequency
  double seconds_running = 0;           ///< of the one that runs, until now
  std::vector<std::string> warnings;    ///< of checkpoints that could not be written
  std::vector<ResponseSample> samples;  ///< of all frequencies until now
  std::vector<StateArray> state;        ///< Stepper::state() of the one that runs; read from a checkpoint only
};

/// What `file` held. \throws InputError naming the file where that is damaged.
RunState to_run_state(Checkpoint checkpoint, const std::filesystem::path& file);

/// Writes all but the stepper's state.
void add_to(Checkpoint& checkpoint, const RunState& at, double seconds_running);

}  // namespace macadam
