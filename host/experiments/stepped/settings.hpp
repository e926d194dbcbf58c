// SPDX-License-Identifier: GPL-3.0-or-later
/// \file settings.hpp  Settings that all stepped tests have in common, for their steppers and in summary.json.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "macadam/simulation.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// As asked for; else condensed, but by points where a law is not linear, or where a facet has one point: that has
/// three chains in place of six.
ContactForm form_of(const Scene& scene);

/// What `[solver]` and the choices made say to every stepper of a run.
StepperOptions stepper_options(const SolverSpec& solver, ContactForm form, Geometry geometry, Precision precision);

/// A stepper that goes on from a checkpoint's state, where that is not empty. `used`: as make_stepper().
/// \throws as make_stepper() and Stepper::set_state().
std::unique_ptr<Stepper> stepper_from(const std::vector<StateArray>& state, Backend backend, const Scene& scene,
                                      const Preparation& prepared, const Inertia& inertia,
                                      const StepperOptions& options, std::unique_ptr<Stepper> used = nullptr);

/// \throws RunError for more steps than anybody waits for; `what` takes them, in words.
void require_possible(double steps, double dt, const std::string& what);

/// Adds to `solver` of summary.json how a test was stepped.
void add_settings(const experiments::Stepped& found, const Scene& scene, const RunResult& run, std::int64_t steps,
                  std::optional<double> dt_s, nlohmann::ordered_json& solver);

}  // namespace macadam
