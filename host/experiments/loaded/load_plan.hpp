// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_plan.hpp  What a scene leaves open of a stepped test of a load, decided once before the first step.
#pragma once

#include <string>
#include <vector>

#include "host/experiments/loaded/load_test.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// How a test is stepped.
struct LoadPlan {
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::updated;
  Precision precision = Precision::double_;
  CriticalStep critical;  ///< at true mass, with the platen
  double density_scaling = 1;
  Damping damping_kind = Damping::none;
  double damping = 0;
  double ramp = 0;         ///< in which the load grows [s]
  double platen_mass = 0;  ///< [kg]; 0: the wall is moved
  double dt = 0;           ///< [s]
  std::vector<std::string> decisions;

  std::int64_t step_at(double time) const;  ///< the nearest one, from 1 on
};

/// Keeps what the scene gives and chooses the rest: docs/relaxation.md says how. \throws InputError for what does not
/// fit this way; RunError for a step that is hopelessly small, or a wall that touches nothing.
LoadPlan make_load_plan(const LoadTest& test, const Scene& scene, const Preparation& prepared, const Inertia& inertia);

/// Returns the modulus that the network has at once if all of it strains alike [Pa]: no less than its true one.
/// `volume`: of the box [m³].
double affine_modulus(const ContactNetwork& network, const FactsTable& laws, double volume);

/// The load on the top wall.
Boundary boundary_of(const LoadTest& test, const LoadPlan& plan, const Box& box);

}  // namespace macadam
