// SPDX-License-Identifier: GPL-3.0-or-later
// drives.cpp  What walls are made to do.
#include "macadam/drives/all.hpp"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "macadam/boundary.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/choices.hpp"

namespace macadam::python {
namespace {

std::vector<double> values_of(const Drive& drive, std::int64_t first, std::int64_t count) {
  std::vector<double> out;
  for (std::int64_t k = first; k < first + count; ++k) out.push_back(drive.value(k));
  return out;
}

void bind_boundary(nb::module_& m) {
  nb::class_<Boundary>(m, "Boundary",
                       "All that acts on a specimen from outside. Walls are \"-x\" \"+x\" \"-y\" \"+y\" \"-z\" \"+z\".")
      .def(nb::init<>())
      .def(
          "move",
          [](Boundary& b, const std::string& wall, const std::string& axis, std::shared_ptr<Drive> drive) -> Boundary& {
            return b.move(choice("wall", wall, walls), choice("axis", axis, axes), std::move(drive));
          },
          nb::rv_policy::none, nb::arg("wall"), nb::arg("axis"), nb::arg("drive"),
          "Drives one axis of a wall by a displacement [m].")
      .def(
          "load",
          [](Boundary& b, const std::string& wall, const std::string& axis, std::shared_ptr<Drive> drive,
             double mass) -> Boundary& {
            return b.load(choice("wall", wall, walls), choice("axis", axis, axes), std::move(drive), mass);
          },
          nb::rv_policy::none, nb::arg("wall"), nb::arg("axis"), nb::arg("drive"), nb::arg("mass"),
          "Loads one axis of a wall of this mass [kg] by a force [N].")
      .def(
          "fix",
          [](Boundary& b, const std::vector<std::int32_t>& particles) -> Boundary& {
            b.fixed = particles;
            return b;
          },
          nb::rv_policy::none, nb::arg("particles"), "Particles that do not move at all.")
      .def(
          "body_force",
          [](Boundary& b, const Vectors& force) -> Boundary& {
            b.body_force = copy(force);
            return b;
          },
          nb::rv_policy::none, nb::arg("force"), "On each particle [N], (n, 3).");
}

}  // namespace

void bind_drives(nb::module_& m) {
  constexpr std::int64_t forever = drives::Ramp::forever;
  nb::class_<Drive>(m, "Drive", "A displacement [m] or a force [N] as a function of the step.")
      .def_prop_ro(
          "dt", [](const Drive& d) { return d.dt(); }, "The time step that it is made for [s].")
      .def("value", &Drive::value, nb::arg("step"), "[m] or [N]")
      .def(
          "values",
          [](const Drive& d, std::int64_t first, std::int64_t count) { return owned(values_of(d, first, count)); },
          nb::arg("first"), nb::arg("count"), "At `count` steps from `first` on.");
  nb::class_<drives::Cyclic, Drive>(m, "Cyclic", "-amplitude·sin(2πft), with a smooth start over `ramp_steps`.")
      .def(nb::init<double, double, std::int64_t, std::int64_t>(), nb::arg("amplitude"), nb::arg("frequency"),
           nb::arg("steps_per_period"), nb::arg("ramp_steps") = 0);
  nb::class_<drives::ConstantRate, Drive>(m, "ConstantRate", "speed·t, of a test that takes `duration` [s].")
      .def(nb::init<double, double, double>(), nb::arg("speed"), nb::arg("dt"), nb::arg("duration"));
  nb::class_<drives::Ramp, Drive>(m, "Ramp", "From 0 to `height` within `ramp_steps`, held for `hold_steps`, and back.")
      .def(nb::init<double, double, std::int64_t, std::int64_t, bool>(), nb::arg("height"), nb::arg("dt"),
           nb::arg("ramp_steps") = 1, nb::arg("hold_steps") = forever, nb::arg("smooth") = false);
  nb::class_<drives::Table, Drive>(m, "Table", "Values at times [s] that ascend, straight lines between them.")
      .def(
          "__init__",
          [](drives::Table* self, double dt, const std::vector<double>& times, const std::vector<double>& values) {
            new (self) drives::Table(dt, times, values);
          },
          nb::arg("dt"), nb::arg("times"), nb::arg("values"));
  bind_boundary(m);
}

}  // namespace macadam::python
