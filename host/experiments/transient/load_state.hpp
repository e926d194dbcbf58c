// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_state.hpp  Stores the state of a stepped test of a load in a checkpoint, and reads it back.
#pragma once

#include <string>
#include <vector>

#include "host/experiments/transient/load_error.hpp"
#include "host/experiments/transient/peak_fit.hpp"
#include "host/run/energy_ledger.hpp"

namespace macadam {

/// Everything that a run needs to continue, with results that have the same bits.
struct LoadState {
  LoadPlan plan;
  experiments::Peak peak;      ///< largest stress until now
  std::uint32_t checksum = 0;  ///< TransientExperiment::checksum
  /// Relaxation, against which errors are measured; if empty, errors are estimated.
  std::optional<UnsteppedAnswer> unstepped;
  double seconds_planning = 0, seconds = 0;       ///< wall time [s]; `seconds`: of the stepping until now
  std::vector<std::string> warnings;              ///< warnings about checkpoints that could not be written
  std::vector<experiments::SteppedPoint> points;  ///< points reached until now
  std::vector<experiments::CrackEvent> cracks;    ///< broken contact points until the last of `points`
  LedgerState ledger;                             ///< balance of energies until the last of `points`
  std::vector<StressSample> stresses;             ///< of a strength test with cracks, at all its samples until now
  std::vector<StateArray> state;                  ///< Stepper::state(); set only when it is read from a checkpoint
};

/// Returns the state in a checkpoint. \throws InputError, naming `file`, if it is damaged.
LoadState to_load_state(Checkpoint checkpoint, const std::filesystem::path& file);

/// Adds everything except the stepper's state to a checkpoint.
void add_to(Checkpoint& checkpoint, const LoadState& at);

}  // namespace macadam
