// SPDX-License-Identifier: GPL-3.0-or-later
/// \file bindings.hpp  Every noun adds itself to the module, in the order in which they need each other.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "host/scene/overrides.hpp"
#include "macadam/simulation.hpp"

namespace macadam::python {

/// A scene as Python has it, with the options that were given beside it.
struct GivenScene : Scene {
  Overrides instead = {};
};

/// A scene's particles, cells and contacts, with the scene.
struct Prepared {
  std::shared_ptr<const GivenScene> scene;
  Preparation made;
};
using PreparedPointer = std::shared_ptr<Prepared>;

void bind_errors(nanobind::module_& m);
void bind_machine(nanobind::module_& m);
void bind_scene(nanobind::module_& m);
void bind_shapes(nanobind::module_& m);
void bind_cells(nanobind::module_& m);
void bind_contacts(nanobind::module_& m);
void bind_specimen(nanobind::module_& m);
void bind_fields(nanobind::module_& m);
void bind_drives(nanobind::module_& m);
void bind_harmonic(nanobind::module_& m);
void bind_spectrum(nanobind::module_& m);
void bind_states(nanobind::module_& m);
void bind_stepper(nanobind::module_& m);
void bind_simulation(nanobind::module_& m);
void bind_fit(nanobind::module_& m);
void bind_calibration(nanobind::module_& m);
void bind_ct(nanobind::module_& m);

}  // namespace macadam::python
