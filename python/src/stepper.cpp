// SPDX-License-Identifier: GPL-3.0-or-later
// stepper.cpp  Binds the stepper, so that a Python program can run its own time loop.
#include "macadam/stepper.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <limits>
#include <stdexcept>

#include "macadam/piecewise_stepper.hpp"
#include "macadam/thread_limit.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/choices.hpp"
#include "python/src/fields.hpp"
#include "python/src/given_arrays.hpp"

namespace macadam::python {
namespace {

/// A stepper, and the specimen that it refers to. One thread at a time may use it.
struct HeldStepper {
  PreparedPointer prepared;
  std::unique_ptr<Stepper> stepper;
  double dt = 0;
  mutable std::mutex busy = {};

  /// Locks the stepper for the lifetime of the returned lock. \throws RunError if another thread holds it.
  std::unique_lock<std::mutex> hold() const {
    std::unique_lock held(busy, std::try_to_lock);
    if (!held) throw RunError("stepper: found a call from another thread, expected one thread at a time");
    return held;
  }
};

/// Returns the time step of the first drive, or nothing if no wall is driven. All drives must have the same time step.
std::optional<double> step_of(const Boundary& boundary) {
  std::optional<double> out;
  for (const WallMotionSpec& wall : boundary.wall) {
    for (const WallAxis& axis : wall.axis) {
      if (axis.drive) out = out.value_or(axis.drive->dt());
    }
  }
  return out;
}

CriticalStep critical(const Prepared& p, const StepperOptions& options) {
  const Materials& m = p.scene->materials;
  return critical_step(p.made.network, p.scene->laws, make_inertia(p.made.specimen, m.aggregate, m.mastic), options);
}

/// Takes steps in pieces of some tenths of a second, and checks for Ctrl-C after each piece.
void advance(HeldStepper& s, std::int64_t steps) {
  if (steps < 0) throw InputError("advance: found " + std::to_string(steps) + " steps, expected 0 or more");
  LongCall call;
  const auto held = s.hold();
  call([&] {
    PiecewiseStepper(*s.stepper).advance(0, steps, [&](std::int64_t) {
      if (call.stop()) throw InterruptedError("interrupted between two steps: the stepper can continue");
    });
  });
}

nb::object array_of(StateArray::Values values) {
  return std::visit([](auto& v) { return nb::cast(owned(std::move(v))); }, values);
}

nb::dict state_of(const HeldStepper& s) {
  const auto held = s.hold();
  nb::dict out;
  for (StateArray& array : s.stepper->state()) out[array.name.c_str()] = array_of(std::move(array.values));
  return out;
}

/// Returns a copy of the numbers if the array is flat and its type is T, otherwise nothing.
template <class T>
std::optional<StateArray::Values> values_as(nb::handle array) {
  nb::ndarray<const T, nb::ndim<1>, nb::c_contig, nb::device::cpu> in;
  if (!nb::try_cast(array, in, false)) return {};
  return StateArray::Values(std::vector<T>(in.data(), in.data() + in.size()));
}

void set_state(HeldStepper& s, const nb::dict& arrays) {
  std::vector<StateArray> state;
  for (const auto& [name, array] : arrays) {
    const std::string text = nb::cast<std::string>(name);
    auto values = values_as<float>(array);
    if (!values) values = values_as<double>(array);
    if (!values) values = values_as<std::int64_t>(array);
    if (!values) {
      const nb::object given = number_array(array, "arrays: " + text, "an array as state() returned it");
      throw InputError(fmt::format(
          "arrays: {}: found {} of shape {}, expected shape (n,) of float32, float64 or int64, as state() returned it",
          text, nb::cast<std::string>(given.attr("dtype").attr("name")), nb::repr(given.attr("shape")).c_str()));
    }
    state.push_back({text, "", std::move(*values)});
  }
  const auto held = s.hold();
  s.stepper->set_state(state);
}

using OnDevice = nb::ndarray<nb::ro, nb::shape<-1, 8>, nb::device::cuda>;

/// Returns the arrays of velocities and displacements on the device without a copy, or None on other backends.
nb::object device_motion(const HeldStepper& s) {
  const auto held = s.hold();
  const DeviceMotion d = s.stepper->device_motion();
  if (!d.velocity) return nb::none();
  const std::size_t shape[] = {d.particle.size() + wall_count, 8};
  const nb::object owner = nb::find(s);
  const auto array = [&](const void* data, bool doubles) {
    return nb::cast(OnDevice(data, 2, shape, owner, nullptr, doubles ? nb::dtype<double>() : nb::dtype<float>(),
                             nb::device::cuda::value, d.device));
  };
  nb::dict out;
  out["velocity"] = array(d.velocity, d.doubles);
  out["displacement"] = array(d.displacement, true);
  out["particle"] = owned(std::vector<std::int32_t>(d.particle));
  return out;
}

nb::list kernels_of(const HeldStepper& s) {
  nb::list out;
  for (const KernelUse& kernel : s.stepper->kernels()) {
    nb::dict one;
    one["name"] = kernel.name;
    one["registers"] = kernel.registers;
    one["shared_bytes"] = kernel.shared_bytes;
    one["occupancy"] = kernel.occupancy;
    out.append(one);
  }
  return out;
}

using Text = std::string;

/// Constructs a Stepper. The time step is `dt` if it is given, else the time step of the drives, else `safety` times
/// the critical step.
void make_stepper_object(HeldStepper* self, PreparedPointer specimen, const Boundary& boundary,
                         std::optional<double> dt, const Text& backend, const Text& precision, const Text& form,
                         const Text& geometry, const Text& damping_kind, double damping, double density_scaling,
                         double safety, bool skip_shear, bool skip_rotations, int threads, const Devices& device,
                         int multiprocessors, const StartState* start, double blocks, std::int64_t observed_every) {
  StepperOptions options;
  options.form = choice("form", form, forms);
  options.geometry = choice("geometry", geometry, geometries);
  options.precision = choice("precision", precision, precisions);
  options.damping_kind = choice("damping_kind", damping_kind, dampings);
  options.damping = damping;
  options.density_scaling = density_scaling;
  options.skip_shear = skip_shear;
  options.skip_rotations = skip_rotations;
  options.multiprocessors = in_range("multiprocessors", multiprocessors, 0, 4096);
  options.blocks = in_range("blocks", blocks, 1.0, 1e18);
  options.threads = in_range("threads", threads, 0, 1024);
  options.devices = devices_of(device).value_or(DeviceList{});
  options.boundary = boundary;
  options.start = start;
  options.observed_every = observed_every;
  const Backend chosen = choice("backend", backend, backends);
  const std::optional<double> driven = step_of(boundary);
  options.dt = dt ? *dt : driven ? *driven : safety * critical(*specimen, options).dt;
  const Materials& m = specimen->scene->materials;
  const Inertia inertia = make_inertia(specimen->made.specimen, m.aggregate, m.mastic);
  LongCall call;
  auto stepper = call([&] {
    const ThreadLimit limit(options.threads);
    return make_stepper(chosen, specimen->made.specimen, specimen->made.network, specimen->scene->laws, inertia,
                        options);
  });
  new (self) HeldStepper{std::move(specimen), std::move(stepper), options.dt};
}

}  // namespace

void bind_stepper(nb::module_& m) {
  nb::class_<HeldStepper>(m, "Stepper",
                          "Steps a specimen in time: velocities at half steps, displacements at whole steps.")
      .def("__init__", &make_stepper_object, nb::arg("specimen"), nb::arg("boundary"), nb::kw_only(),
           nb::arg("dt") = nb::none(), nb::arg("backend") = "auto", nb::arg("precision") = "double",
           nb::arg("form") = "condensed", nb::arg("geometry") = "updated", nb::arg("damping_kind") = "none",
           nb::arg("damping") = 0.0, nb::arg("density_scaling") = 1.0, nb::arg("safety") = 0.8,
           nb::arg("skip_shear") = true, nb::arg("skip_rotations") = true, nb::arg("threads") = 0,
           nb::arg("device") = nb::none(), nb::arg("multiprocessors") = 0, nb::arg("start") = nb::none(),
           nb::arg("blocks") = StepperOptions{}.blocks, nb::arg("observed_every") = 0,
           "dt: time step [s]; by default the step of the drives or, without drives, `safety` times the critical step. "
           "damping: χ, or β [1/s] of viscous damping. skip_shear, skip_rotations: leave out shear or rotations that "
           "are "
           "always 0. start: state from which the run starts (steady_start). For backend cuda: multiprocessors: number "
           "of "
           "multiprocessors to plan for, 0: all; blocks: smallest number of blocks of steps in the shortest time of "
           "drives "
           "and laws; observed_every: number of steps from one observe() to the next, 0: unknown.")
      .def("advance", &advance, nb::arg("steps"),
           "Takes steps. Other threads of Python run at the same time. Ctrl-C ends it after a whole step.")
      .def(
          "observe",
          [](const HeldStepper& s) {
            const auto held = s.hold();
            return s.stepper->observe();
          },
          "Returns the present state of the walls.")
      .def(
          "particles",
          [](const HeldStepper& s) {
            const auto held = s.hold();
            return s.stepper->particles();
          },
          "Returns the present motion of all particles.")
      .def(
          "contacts",
          [](const HeldStepper& s) {
            const auto held = s.hold();
            return s.stepper->contacts(s.prepared->made.network);
          },
          "Returns present forces and deformation of all contacts.")
      .def(
          "stress",
          [](const HeldStepper& s) {
            const auto held = s.hold();
            return stress_of(s.prepared->made, s.stepper->contacts(s.prepared->made.network));
          },
          "Returns the mean stress in each particle's cell [Pa], (n, 6): xx yy zz xy yz xz, tension positive.")
      .def(
          "set_velocities",
          [](HeldStepper& s, const ArrayLike& velocity, const ArrayLike& spin) {
            const std::size_t particles = s.prepared->made.specimen.size();
            const std::vector<Vec3d> v = vectors(velocity, "velocity", particles), w = vectors(spin, "spin", particles);
            const auto held = s.hold();
            s.stepper->set_velocities(v, w);
          },
          nb::arg("velocity"), nb::arg("spin"),
          "Sets velocities [m/s] and angular velocities [rad/s] of the particles at the last half step, (n, 3) each.")
      .def("state", &state_of, "Returns all data that steps change, as arrays by name.")
      .def("set_state", &set_state, nb::arg("arrays"), "Restores the arrays that state() returned.")
      .def("device_motion", &device_motion,
           "Returns arrays on the device (DLPack, without a copy), valid until the next call; None for other backends "
           "than "
           "cuda. Rows are particles, followed by the walls. velocity, (rows, 8): v, -, ω, - [m/s, rad/s]. "
           "displacement, "
           "(rows, 8): u, -, θ, - [m, rad]. particle: number of the particle of each row without the walls.")
      .def_prop_ro("kernels", &kernels_of,
                   "Kernels that a step launches on backend cuda: name, registers, shared_bytes, occupancy.")
      .def_prop_ro(
          "dt", [](const HeldStepper& s) { return s.dt; }, "Time step [s].")
      .def_prop_ro("specimen", [](const HeldStepper& s) { return s.prepared; })
      .def("__repr__",
           [](const HeldStepper& s) {
             return fmt::format("<macadam.Stepper: {} particles, dt {:.4g} s, {}>", s.prepared->made.specimen.size(),
                                s.dt, s.stepper->description());
           })
      .def_prop_ro(
          "first_divergent",
          [](const HeldStepper& s) {
            const auto held = s.hold();
            return s.stepper->first_divergent();
          },
          "First particle whose motion is not finite or exceeds its radius in a step; -1 if none.")
      .def_prop_ro(
          "description", [](const HeldStepper& s) { return s.stepper->description(); },
          "Backend, precision and form that run, in words.")
      .def_prop_ro(
          "bytes", [](const HeldStepper& s) { return s.stepper->bytes(); },
          "Bytes of state and geometry held for the step.")
      .def_prop_ro(
          "traffic", [](const HeldStepper& s) { return s.stepper->traffic(); },
          "Smallest number of bytes that a step reads and writes.");
  m.def(
      "critical_step",
      [](const Prepared& p, double density_scaling, double damping) {
        StepperOptions options;
        options.density_scaling = density_scaling;
        options.damping = damping;
        options.damping_kind = damping > 0 ? Damping::local : Damping::none;
        return critical(p, options).dt;
      },
      nb::arg("specimen"), nb::arg("density_scaling") = 1.0, nb::arg("damping") = 0.0,
      "Returns a stable time step [s]. damping: χ of local damping.");
}

}  // namespace macadam::python
