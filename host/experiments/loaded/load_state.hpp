// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_state.hpp  Where a stepped test of a load stands, as a part of a checkpoint.
#pragma once

#include <string>
#include <vector>

#include "host/experiments/loaded/load_error.hpp"

namespace macadam {

/// All that a run needs to go on to the same bits.
struct LoadState {
  LoadPlan plan;
  experiments::Peak peak;                         ///< until now
  std::optional<UnsteppedAnswer> unstepped;       ///< that errors are measured against; nothing: they are estimates
  double seconds_planning = 0, seconds = 0;       ///< wall time, the latter of the stepping until now
  std::vector<std::string> warnings;              ///< of checkpoints that could not be written
  std::vector<experiments::SteppedPoint> points;  ///< until now
  std::vector<experiments::CrackEvent> cracks;    ///< until the last of the points
  std::vector<StateArray> state;                  ///< Stepper::state(); read from a checkpoint only
};

/// What `file` held. \throws InputError naming the file where that is damaged.
LoadState to_load_state(Checkpoint checkpoint, const std::filesystem::path& file);

/// Writes all but the stepper's state.
void add_to(Checkpoint& checkpoint, const LoadState& at);

}  // namespace macadam
