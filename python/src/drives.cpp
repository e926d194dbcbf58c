// SPDX-License-Identifier: GPL-3.0-or-later
// drives.cpp  Binds the drives (displacements and forces of walls as functions of the step) and the Boundary that
// applies them to walls.
#include "macadam/drives/all.hpp"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>

#include "macadam/boundary.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/choices.hpp"
#include "python/src/given_arrays.hpp"

namespace macadam::python {
namespace {

std::vector<double> values_of(const Drive& drive, std::int64_t first, std::int64_t count) {
  std::vector<double> out;
  for (std::int64_t k = first; k < first + count; ++k) out.push_back(drive.value(k));
  return out;
}

constexpr std::int64_t largest_step_count = std::int64_t{1}
                                            << 60;  // the sum of two such numbers does not overflow 64 bits

/// Returns `value`, which is a number of steps. \throws InputError, naming the argument, if it is below `least` or too
/// large.
std::int64_t checked_steps(const char* name, std::int64_t value, std::int64_t least) {
  return in_range(name, value, least, largest_step_count);
}

void require_positive(const char* name, double value, const char* unit) {
  if (!(value > 0 && std::isfinite(value)))
    throw InputError(fmt::format("{}: found {}, expected a number above 0 {}", name, value, unit));
}

/// Returns the boundary as text: the driven axes of walls, and the numbers of fixed and loaded particles.
std::string text_of(const Boundary& b) {
  std::string out = "<macadam.Boundary:";
  bool any = false;
  const auto add = [&](const std::string& words) { out += (any ? ", " : " ") + words, any = true; };
  for (std::size_t wall = 0; wall < b.wall.size(); ++wall) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const DrivenBy by = b.wall[wall].axis[axis].by;
      if (by == DrivenBy::rest) continue;
      const bool is_force = by == DrivenBy::force;
      add(fmt::format("wall {} {} along {}", wall_names[wall], is_force ? "loaded" : "moved", "xyz"[axis]) +
          (is_force ? fmt::format(" with {:.4g} kg", b.wall[wall].mass) : ""));
    }
  }
  if (!b.fixed.empty()) add(fmt::format("{} fixed particles", b.fixed.size()));
  if (!b.body_force.empty()) add(fmt::format("forces on {} particles", b.body_force.size()));
  return out + (any ? ">" : " all walls at rest>");
}

void bind_boundary(nb::module_& m) {
  nb::class_<Boundary>(m, "Boundary",
                       "Loads and constraints of a specimen. The walls are \"-x\" \"+x\" \"-y\" \"+y\" \"-z\" \"+z\".")
      .def(nb::init<>())
      .def("__repr__", &text_of)
      .def(
          "move",
          [](Boundary& b, const std::string& wall, const std::string& axis, std::shared_ptr<Drive> drive) -> Boundary& {
            return b.move(choice("wall", wall, walls), choice("axis", axis, axes), std::move(drive));
          },
          nb::rv_policy::none, nb::arg("wall"), nb::arg("axis"), nb::arg("drive"),
          "Prescribes the displacement [m] of a wall along one axis.")
      .def(
          "load",
          [](Boundary& b, const std::string& wall, const std::string& axis, std::shared_ptr<Drive> drive,
             double mass) -> Boundary& {
            return b.load(choice("wall", wall, walls), choice("axis", axis, axes), std::move(drive), mass);
          },
          nb::rv_policy::none, nb::arg("wall"), nb::arg("axis"), nb::arg("drive"), nb::arg("mass"),
          "Applies a force [N] along one axis to a wall of this mass [kg].")
      .def(
          "fix",
          [](Boundary& b, const ArrayLike& particles) -> Boundary& {
            b.fixed = whole_numbers(particles, "particles");
            return b;
          },
          nb::rv_policy::none, nb::arg("particles"), "Holds these particles (numbers, (n,)) at rest.")
      .def(
          "body_force",
          [](Boundary& b, const ArrayLike& force) -> Boundary& {
            b.body_force = vectors(force, "force");
            return b;
          },
          nb::rv_policy::none, nb::arg("force"), "Applies a constant force to each particle [N], (n, 3).");
}

}  // namespace

void bind_drives(nb::module_& m) {
  constexpr std::int64_t forever = drives::Ramp::forever;
  nb::class_<Drive>(m, "Drive", "A displacement [m] or a force [N] as a function of the step.")
      .def_prop_ro(
          "dt", [](const Drive& d) { return d.dt(); }, "Time step of the drive [s].")
      .def("value", &Drive::value, nb::arg("step"), "Value at a step [m] or [N].")
      .def(
          "values",
          [](const Drive& d, std::int64_t first, std::int64_t count) { return owned(values_of(d, first, count)); },
          nb::arg("first"), nb::arg("count"), "Values at `count` steps beginning with `first`, (count,).")
      .def("rate", &Drive::rate, nb::arg("step"), "Mean rate from this step to the next [m/s] or [N/s].")
      .def_prop_ro("shortest_time", &Drive::shortest_time,
                   "Shortest time in which the drive changes considerably [s], for example a period or a ramp.")
      .def_prop_ro("fastest", &Drive::fastest, "Largest absolute rate [m/s] or [N/s].");
  nb::class_<drives::Cyclic, Drive>(m, "Cyclic", "-amplitude·sin(2πft), with a smooth start over `ramp_steps`.")
      .def(
          "__init__",
          [](drives::Cyclic* self, double amplitude, double frequency, std::int64_t steps_per_period,
             std::int64_t ramp_steps) {
            require_positive("frequency", frequency, "Hz");
            new (self) drives::Cyclic(amplitude, frequency, checked_steps("steps_per_period", steps_per_period, 1),
                                      checked_steps("ramp_steps", ramp_steps, 0));
          },
          nb::arg("amplitude"), nb::arg("frequency"), nb::arg("steps_per_period"), nb::arg("ramp_steps") = 0);
  nb::class_<drives::ConstantRate, Drive>(m, "ConstantRate", "speed·t for a test that takes `duration` [s].")
      .def(
          "__init__",
          [](drives::ConstantRate* self, double speed, double dt, double duration) {
            require_positive("dt", dt, "s");
            new (self) drives::ConstantRate(speed, dt, duration);
          },
          nb::arg("speed"), nb::arg("dt"), nb::arg("duration"));
  nb::class_<drives::Ramp, Drive>(
      m, "Ramp", "Grows from 0 to `height` in `ramp_steps`, stays there for `hold_steps`, and returns to 0.")
      .def(
          "__init__",
          [](drives::Ramp* self, double height, double dt, std::int64_t ramp_steps, std::int64_t hold_steps,
             bool smooth) {
            require_positive("dt", dt, "s");
            new (self)
                drives::Ramp(height, dt, checked_steps("ramp_steps", ramp_steps, 1),
                             hold_steps == forever ? forever : checked_steps("hold_steps", hold_steps, 0), smooth);
          },
          nb::arg("height"), nb::arg("dt"), nb::arg("ramp_steps") = 1, nb::arg("hold_steps") = forever,
          nb::arg("smooth") = false);
  nb::class_<drives::Haversine, Drive>(
      m, "Haversine", "Pulses height·sin²(πt/pulse) of `pulse_steps`, each followed by `rest_steps` of 0.")
      .def(
          "__init__",
          [](drives::Haversine* self, double height, double dt, std::int64_t pulse_steps, std::int64_t rest_steps,
             std::int64_t pulses) {
            require_positive("dt", dt, "s");
            new (self) drives::Haversine(height, dt, checked_steps("pulse_steps", pulse_steps, 1),
                                         checked_steps("rest_steps", rest_steps, 0),
                                         in_range<std::int64_t>("pulses", pulses, 0, forever));
          },
          nb::arg("height"), nb::arg("dt"), nb::arg("pulse_steps"), nb::arg("rest_steps") = 0,
          nb::arg("pulses") = forever);
  nb::class_<drives::Table, Drive>(m, "Table", "Values at ascending times [s], with linear interpolation between them.")
      .def(
          "__init__",
          [](drives::Table* self, double dt, const ArrayLike& times, const ArrayLike& values) {
            require_positive("dt", dt, "s");
            const std::vector<double> at = numbers(times, "times");
            new (self) drives::Table(dt, at, numbers(values, "values", at.size()));
          },
          nb::arg("dt"), nb::arg("times"), nb::arg("values"));
  bind_boundary(m);
}

}  // namespace macadam::python
