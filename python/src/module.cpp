// SPDX-License-Identifier: GPL-3.0-or-later
// module.cpp  Defines the compiled module macadam._core, a thin layer over the library. The Python files of macadam/
// add the interface that users call.
#include "python/src/bindings.hpp"

NB_MODULE(_core, m) {
  using namespace macadam::python;
  m.doc() = "The library of Macadam. Use the package macadam, which wraps it. SI units.";
  bind_errors(m);
  bind_machine(m);
  bind_scene(m);
  bind_shapes(m);
  bind_cells(m);
  bind_contacts(m);
  bind_specimen(m);
  bind_fields(m);
  bind_drives(m);
  bind_harmonic(m);
  bind_spectrum(m);
  bind_states(m);
  bind_stepper(m);
  bind_simulation(m);
  bind_fit(m);
  bind_calibration(m);
  bind_ct(m);
}
