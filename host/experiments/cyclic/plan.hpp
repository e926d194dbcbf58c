// SPDX-License-Identifier: GPL-3.0-or-later
/// \file plan.hpp  What a scene leaves open of an explicit run, decided once before the first step.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "macadam/harmonic.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// How one frequency is stepped.
struct FrequencyPlan {
  drives::Cyclic loading;
  double density_scaling = 1;
  Start start = Start::rest;
  int cycles = 0, fit_cycles = 0;
  std::optional<Stiffness> known;            ///< of the harmonic solver at true mass
  std::optional<ErrorEstimate> predicted;    ///< with respect to it
  std::vector<std::complex<double>> motion;  ///< of the steady start: HarmonicResult::motion with this inertia
};

/// How a scene is stepped.
struct Plan {
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::updated;
  Precision precision = Precision::double_;
  double geometry_error = 0;  ///< of |E*|, at most about, by the geometry of the start
  CriticalStep critical;      ///< at true mass
  std::vector<FrequencyPlan> frequencies;
  std::vector<std::string> decisions;  ///< what was chosen and why, a sentence each
};

/// Keeps what the scene gives; where it gives a tolerance, chooses the rest so that |E*| and φ are expected to differ
/// by less from those of true mass, else takes fixed defaults. \throws RunError when the step would be hopelessly
/// small.
/// `backend`: on which it is stepped, which also solves. `phases`: what takes how long is added there.
Plan make_plan(const Scene& scene, const Preparation& prepared, const Inertia& inertia, const Watcher& watcher,
               Backend backend, PhaseSeconds& phases);

}  // namespace macadam
