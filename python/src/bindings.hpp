// SPDX-License-Identifier: GPL-3.0-or-later
/// \file bindings.hpp  Declares one function for each source file of the bindings, which adds that file's classes and
/// functions to the module, and the two types that several of them use. The functions are called in this order because
/// a class must be bound before another one refers to it.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "macadam/overrides.hpp"
#include "macadam/simulation.hpp"

namespace macadam::python {

/// The scene object of Python: a scene, and the options (seed, backend, …) by which the caller replaced values of the
/// scene.
struct GivenScene : Scene {
  Overrides instead = {};  ///< Options that replace the scene's own values.
};

/// The specimen object of Python: particles, cells and contacts, and the scene that they were made from.
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
