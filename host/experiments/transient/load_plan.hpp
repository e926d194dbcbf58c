// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_plan.hpp  Chooses the settings that a scene leaves open for a stepped test of a load. All settings
/// are chosen once, before the first step.
#pragma once

#include <string>
#include <vector>

#include "host/experiments/transient/transient_experiment.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// The settings with which a test is stepped.
struct LoadPlan {
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::updated;
  Precision precision = Precision::double_;
  CriticalStep critical;  ///< critical time step at true mass, with the platen
  double density_scaling = 1;
  Damping damping_kind = Damping::none;
  double damping = 0;
  double ramp = 0;         ///< time in which the load grows [s]
  double platen_mass = 0;  ///< mass of the loaded top wall [kg]; 0: the wall is displaced, not loaded
  double dt = 0;           ///< time step [s]
  std::vector<std::string> decisions;

  std::int64_t step_at(double time) const;  ///< number of the step nearest to a time, at least 1
};

/// Keeps the settings that the scene gives and chooses the others; docs/relaxation.md explains how. \throws InputError
/// for settings that do not apply to stepped tests of a load; RunError if the time step would be so small that a run is
/// impossible, or if the top wall touches no particle.
LoadPlan make_load_plan(const TransientExperiment& test, const Scene& scene, const Preparation& prepared,
                        const Inertia& inertia);

/// Returns the instantaneous modulus that the network would have if all its parts had the same strain [Pa]. The true
/// modulus is at most this one. `volume`: volume of the box [m³].
double affine_modulus(const ContactNetwork& network, const FactsTable& laws, double volume);

/// Returns the load on the top wall as a boundary condition.
Boundary boundary_of(const TransientExperiment& test, const LoadPlan& plan, const Box& box);

}  // namespace macadam
