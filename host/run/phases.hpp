// SPDX-License-Identifier: GPL-3.0-or-later
/// \file phases.hpp  Assigns the wall time of a run to its phases. Every moment of a run is counted in exactly one
/// phase.
#pragma once

#include <chrono>

#include "macadam/simulation.hpp"

namespace macadam {

/// Adds the lifetime of this object to the time of a phase. If another phase begins and ends during this lifetime, its
/// time is counted only in that other phase.
class InPhase {
 public:
  InPhase(PhaseSeconds& all, double PhaseSeconds::*phase) : all_(all), phase_(phase), before_(all.sum()) {}
  InPhase(const InPhase&) = delete;
  InPhase& operator=(const InPhase&) = delete;
  ~InPhase() {
    const double lived = std::chrono::duration<double>(Clock::now() - start_).count();
    all_.*phase_ += lived - (all_.sum() - before_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  PhaseSeconds& all_;
  double PhaseSeconds::*phase_;
  double before_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace macadam
