// SPDX-License-Identifier: GPL-3.0-or-later
// stepper.cpp  Binds the stepper, with which a Python program advances a specimen in time itself.
#include "macadam/stepper.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <limits>
#include <stdexcept>

#include "host/base/thread_limit.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/choices.hpp"
#include "python/src/fields.hpp"
#include "python/src/given_arrays.hpp"

namespace macadam::python {
namespace {

/// A stepper, and the specimen that it refers to. One thread at a time may use it.
struct Steps {
  PreparedPointer prepared;
  std::unique_ptr<Stepper> stepper;
  double dt = 0;
  mutable std::mutex busy = {};

  /// Locks the stepper as long as the returned lock lives. \throws RunError if another thread holds it.
  std::unique_lock<std::mutex> hold() const {
    std::unique_lock held(busy, std::try_to_lock);
    if (!held) throw RunError("stepper: found another thread at it, expected one at a time");
    return held;
  }
};

/// Returns the time step that the drives were made for, or nothing if no wall is driven. All drives must have the same
/// step; the first drive's is returned.
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

/// Advances in pieces of 0.1 to 0.4 s and looks for Ctrl-C after each. Results do not depend on the length of the
/// pieces, to the last bit.
void advance(Steps& s, std::int64_t steps) {
  if (steps < 0) throw InputError("advance: found " + std::to_string(steps) + " steps, expected none or more");
  LongCall call;
  const auto held = s.hold();
  call([&] {
    using Clock = std::chrono::steady_clock;
    for (std::int64_t piece = 16; steps > 0;) {
      const auto start = Clock::now();
      const std::int64_t now = std::min(piece, steps);
      s.stepper->advance(now);
      steps -= now;
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      if (seconds < 0.1) piece *= 2;
      if (seconds > 0.4) piece = std::max<std::int64_t>(1, piece / 2);
      if (call.stop()) throw InterruptedError("interrupted: the stepper stands at a whole step, and may go on");
    }
  });
}

nb::object array_of(StateArray::Values values) {
  return std::visit([](auto& v) { return nb::cast(owned(std::move(v))); }, values);
}

nb::dict state_of(const Steps& s) {
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

void set_state(Steps& s, const nb::dict& arrays) {
  std::vector<StateArray> state;
  for (const auto& [name, array] : arrays) {
    const std::string text = nb::cast<std::string>(name);
    auto values = values_as<float>(array);
    if (!values) values = values_as<double>(array);
    if (!values) values = values_as<std::int64_t>(array);
    if (!values) {
      const nb::object found = number_array(array, "arrays: " + text, "an array as state() gave it");
      throw InputError(fmt::format(
          "arrays: {}: found {} of shape {}, expected a flat array of float32, float64 or int64, as state() gave it",
          text, nb::cast<std::string>(found.attr("dtype").attr("name")), nb::repr(found.attr("shape")).c_str()));
    }
    state.push_back({text, "", std::move(*values)});
  }
  const auto held = s.hold();
  s.stepper->set_state(state);
}

using OnDevice = nb::ndarray<nb::ro, nb::shape<-1, 8>, nb::device::cuda>;

/// Returns the arrays of velocities and displacements on the device without a copy, or None on other backends.
nb::object device_motion(const Steps& s) {
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

nb::list kernels_of(const Steps& s) {
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

/// Constructs a Stepper. The time step is `dt` if it is given, else that of the drives, else `safety` times the
/// critical step.
void make(Steps* self, PreparedPointer specimen, const Boundary& boundary, std::optional<double> dt,
          const Text& backend, const Text& precision, const Text& form, const Text& geometry, const Text& damping_kind,
          double damping, double density_scaling, double safety, bool skip_shear, bool skip_rotations, int threads,
          const Devices& device, int multiprocessors, const StartState* start, double blocks,
          std::int64_t observed_every) {
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
  const Backend where = choice("backend", backend, backends);
  const std::optional<double> driven = step_of(boundary);
  options.dt = dt ? *dt : driven ? *driven : safety * critical(*specimen, options).dt;
  const Materials& m = specimen->scene->materials;
  const Inertia inertia = make_inertia(specimen->made.specimen, m.aggregate, m.mastic);
  LongCall call;
  auto stepper = call([&] {
    const ThreadLimit limit(options.threads);
    return make_stepper(where, specimen->made.specimen, specimen->made.network, specimen->scene->laws, inertia,
                        options);
  });
  new (self) Steps{std::move(specimen), std::move(stepper), options.dt};
}

}  // namespace

void bind_stepper(nb::module_& m) {
  nb::class_<Steps>(m, "Stepper", "Steps a specimen in time: velocities at half steps, displacements at whole steps.")
      .def(
          "__init__", &make, nb::arg("specimen"), nb::arg("boundary"), nb::kw_only(), nb::arg("dt") = nb::none(),
          nb::arg("backend") = "auto", nb::arg("precision") = "double", nb::arg("form") = "condensed",
          nb::arg("geometry") = "updated", nb::arg("damping_kind") = "none", nb::arg("damping") = 0.0,
          nb::arg("density_scaling") = 1.0, nb::arg("safety") = 0.8, nb::arg("skip_shear") = true,
          nb::arg("skip_rotations") = true, nb::arg("threads") = 0, nb::arg("device") = nb::none(),
          nb::arg("multiprocessors") = 0, nb::arg("start") = nb::none(), nb::arg("blocks") = StepperOptions{}.blocks,
          nb::arg("observed_every") = 0,
          "dt [s]: that of the drives, else `safety` times the critical step. damping: χ, or β [1/s] of viscous "
          "damping. skip_shear, skip_rotations: leave out what is 0. start: a state of motion (steady_start). Of cuda: "
          "multiprocessors: plan for so many, 0: all; blocks: so many of them at least in the shortest time of drives "
          "and laws; observed_every: steps from one observe() to the next, 0: not known.")
      .def("advance", &advance, nb::arg("steps"), "Takes steps. Other threads of Python run meanwhile; Ctrl-C ends it.")
      .def(
          "observe",
          [](const Steps& s) {
            const auto held = s.hold();
            return s.stepper->observe();
          },
          "Walls now.")
      .def(
          "particles",
          [](const Steps& s) {
            const auto held = s.hold();
            return s.stepper->particles();
          },
          "Motion of all particles now.")
      .def(
          "contacts",
          [](const Steps& s) {
            const auto held = s.hold();
            return s.stepper->contacts(s.prepared->made.network);
          },
          "Forces and deformation of all contacts now.")
      .def(
          "stress",
          [](const Steps& s) {
            const auto held = s.hold();
            return stress_of(s.prepared->made, s.stepper->contacts(s.prepared->made.network));
          },
          "Mean stress in each particle's cell [Pa], (n, 6): xx yy zz xy yz xz, tension positive.")
      .def(
          "set_velocities",
          [](Steps& s, const ArrayLike& velocity, const ArrayLike& spin) {
            const std::size_t particles = s.prepared->made.specimen.size();
            const std::vector<Vec3d> v = vectors(velocity, "velocity", particles), w = vectors(spin, "spin", particles);
            const auto held = s.hold();
            s.stepper->set_velocities(v, w);
          },
          nb::arg("velocity"), nb::arg("spin"), "At the half step, specimen order [m/s], [rad/s], (n, 3).")
      .def("state", &state_of, "Everything that steps change, as arrays by name.")
      .def("set_state", &set_state, nb::arg("arrays"), "Puts back what state() gave.")
      .def("device_motion", &device_motion,
           "Of backend cuda, arrays on the device by DLPack, without a copy, valid until the next call: velocity "
           "[body][8] v, -, ω, - [m/s, rad/s], displacement [body][8] u, -, θ, - [m, rad]; `particle`: of each body, "
           "walls behind. Else None.")
      .def_prop_ro("kernels", &kernels_of,
                   "Of backend cuda, what a step launches: name, registers, shared_bytes, occupancy.")
      .def_prop_ro(
          "dt", [](const Steps& s) { return s.dt; }, "[s]")
      .def_prop_ro("specimen", [](const Steps& s) { return s.prepared; })
      .def("__repr__",
           [](const Steps& s) {
             return fmt::format("<macadam.Stepper: {} particles, dt {:.4g} s, {}>", s.prepared->made.specimen.size(),
                                s.dt, s.stepper->description());
           })
      .def_prop_ro(
          "first_divergent",
          [](const Steps& s) {
            const auto held = s.hold();
            return s.stepper->first_divergent();
          },
          "First particle whose motion is not finite or exceeds its radius in a step; -1 if none.")
      .def_prop_ro(
          "description", [](const Steps& s) { return s.stepper->description(); }, "What runs, in words.")
      .def_prop_ro(
          "bytes", [](const Steps& s) { return s.stepper->bytes(); }, "Held for the step.")
      .def_prop_ro(
          "traffic", [](const Steps& s) { return s.stepper->traffic(); }, "Bytes that a step moves at the least.");
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
      "A step that is surely stable [s], for local damping χ.");
}

}  // namespace macadam::python
