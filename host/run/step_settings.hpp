// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_settings.hpp  Makes the stepper options that all stepped tests have in common, and writes the settings
/// used to summary.json.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "macadam/simulation.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// Returns the contact form that the scene requests. If it requests none, returns `points` if a law is not linear. Also
/// returns `points` if every facet has only one contact point, because a contact then has three chains of springs and
/// dashpots, and in condensed form it would have six. Otherwise returns `condensed`.
ContactForm form_of(const Scene& scene);

/// Returns the options that all steppers of a run have in common, from `[solver]` and the choices made for the run.
StepperOptions stepper_options(const SolverSpec& solver, ContactForm form, Geometry geometry, Precision precision);

/// Returns a stepper. If `state`, the state in a checkpoint, is not empty, the stepper continues from it. `used`: as
/// for make_stepper(). \throws as make_stepper() and Stepper::set_state() do.
std::unique_ptr<Stepper> stepper_from(const std::vector<StateArray>& state, Backend backend, const Scene& scene,
                                      const Preparation& prepared, const Inertia& inertia,
                                      const StepperOptions& options, std::unique_ptr<Stepper> used = nullptr);

/// Checks the number of steps. `what` names the part of the run that takes them. \throws RunError for 1e12 steps or
/// more.
void require_possible(double steps, double dt, const std::string& what);

/// Returns the names of those keys in `[solver]` of the scene that only time steps use, joined by commas; empty if the
/// scene has none of them.
std::string keys_of_steps(const SolverSpec& solver);

/// Adds the settings of a test by increments to `solver` of summary.json.
void add_increment_settings(const experiments::Stepped& found, const RunResult& run, nlohmann::ordered_json& solver);

/// Adds the settings with which a test was stepped to `solver` of summary.json.
void add_settings(const experiments::Stepped& found, const Scene& scene, const RunResult& run, std::int64_t steps,
                  std::optional<double> dt_s, nlohmann::ordered_json& solver);

}  // namespace macadam
