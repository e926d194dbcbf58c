// SPDX-License-Identifier: GPL-3.0-or-later
/// \file plan.hpp  Chooses the settings that a scene leaves open for an explicit run. All settings are chosen once,
/// before the first step.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "macadam/harmonic.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// The settings with which one frequency is stepped.
struct FrequencyPlan {
  drives::Cyclic loading;
  double density_scaling = 1;
  Start start = Start::rest;
  int cycles = 0, fit_cycles = 0;
  std::optional<Stiffness> known;            ///< result of the harmonic solver at true mass
  std::optional<ErrorEstimate> predicted;    ///< predicted difference of this run from `known`
  std::vector<std::complex<double>> motion;  ///< for a steady start: HarmonicResult::motion with the run's inertia
};

/// The settings with which a scene is stepped.
struct Plan {
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::updated;
  Precision precision = Precision::double_;
  /// Approximate largest relative error of |E*| from keeping the initial geometry; 0 if the geometry is updated.
  double geometry_error = 0;
  CriticalStep critical;      ///< critical time step at true mass; not used by increments
  int samples_per_cycle = 0;  ///< number of samples in each cycle
  std::vector<FrequencyPlan> frequencies;
  std::vector<std::string> decisions;  ///< the choices and their reasons, one sentence each
};

/// Keeps the settings that the scene gives. With a tolerance, chooses the other settings so that |E*| and φ are
/// expected to differ by less than the tolerance from |E*| and φ at true mass. Without a tolerance, uses fixed
/// defaults. `backend`: the backend that takes the steps and solves in the frequency domain. The time of each part is
/// added to `phases`. \throws RunError if the time step would be so small that a run is impossible.
Plan make_plan(const Scene& scene, const Preparation& prepared, const Inertia& inertia, const Watcher& watcher,
               Backend backend, PhaseSeconds& phases);

}  // namespace macadam
