// SPDX-License-Identifier: GPL-3.0-or-later
// harmonic.cpp  Binds the solver of the frequency domain: steady states at single frequencies, with the motion of every
// particle, and the start of a stepped run from such a state.
#include "macadam/harmonic.hpp"

#include <nanobind/stl/complex.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "macadam/thread_limit.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/choices.hpp"
#include "python/src/given_arrays.hpp"

namespace macadam::python {
namespace {

/// A solver of the frequency domain, and the specimen that it refers to. One thread at a time solves; others wait.
class Solver {
 public:
  Solver(PreparedPointer prepared, double typical, Backend backend, LinearMethod linear, const Devices& device,
         double tolerance)
      : prepared_(std::move(prepared)) {
    const Scene& scene = *prepared_->scene;
    HarmonicOptions options;
    options.tolerance = tolerance;
    options.linear = linear;
    options.backend = backend;
    options.devices = devices_of(device).value_or(DeviceList{});
    options.stop = [this] { return call_ && call_->stop(); };
    const Inertia inertia = make_inertia(prepared_->made.specimen, scene.materials.aggregate, scene.materials.mastic);
    LongCall call;
    call_ = &call;
    call([&] {
      const ThreadLimit threads(prepared_->scene->solver.threads);
      harmonic_.emplace(prepared_->made.specimen, prepared_->made.network, scene.laws, inertia, options, typical);
    });
    call_ = nullptr;
  }

  std::vector<HarmonicResult> solve(const ArrayLike& frequencies, double scaling, double damping) {
    std::vector<HarmonicLoad> loads;
    for (const double f : numbers(frequencies, "frequencies")) loads.push_back({f, scaling, damping});
    std::unique_lock one_at_a_time(busy_, std::defer_lock);
    {
      // The thread that is solving needs the interpreter's lock when it calls stop()
      const nb::gil_scoped_release release;
      one_at_a_time.lock();
    }
    LongCall call;
    call_ = &call;
    try {
      auto out = call([&] {
        const ThreadLimit threads(prepared_->scene->solver.threads);
        return harmonic_->solve(loads);
      });
      call_ = nullptr;
      return out;
    } catch (...) {
      call_ = nullptr;
      throw;
    }
  }

  const Prepared& prepared() const { return *prepared_; }

 private:
  PreparedPointer prepared_;
  std::optional<Harmonic> harmonic_;
  LongCall* call_ = nullptr;  // the running call; options.stop asks it whether to stop
  std::mutex busy_;
};

/// Returns the fraction of E* that each pair type carries, by name; pair types that carry nothing are left out.
nb::dict fractions_of(const HarmonicResult& r) {
  nb::dict out;
  const auto all = shares(r.parts);
  for (std::size_t pair = 0; pair < all.size(); ++pair)
    if (r.parts.normal[pair] != 0.0 || r.parts.shear[pair] != 0.0)
      out[to_string(static_cast<PairType>(pair))] = all[pair];
  return out;
}

nb::list sensitivities_of(const HarmonicResult& r, const Prepared& p) {
  nb::list out;
  const std::complex<double> at = HarmonicLoad{r.frequency_hz}.s();
  const bool of_phases = has_laws_of_phases(p.scene->network.rule);
  for (const Sensitivity& s :
       of_phases ? phase_sensitivities(r.parts, p.scene->laws, at) : sensitivities(r.parts, p.scene->laws, at)) {
    nb::dict one;
    one["parameter"] = s.parameter;
    one["d_e_star_pa"] = s.d_e_star_pa;
    one["d_phase_deg"] = s.d_phase_deg;
    out.append(one);
  }
  return out;
}

}  // namespace

void bind_harmonic(nb::module_& m) {
  nb::class_<HarmonicResult>(m, "SteadyState", "Steady state at one frequency.")
      .def("__repr__",
           [](const HarmonicResult& r) {
             return fmt::format("<macadam.SteadyState: {:.6g} Hz, |E*| {:.6g} Pa, phase {:.4g} degrees>",
                                r.frequency_hz, r.top.e_star_pa, r.top.phase_deg);
           })
      .def_ro("frequency_hz", &HarmonicResult::frequency_hz, "Frequency [Hz].")
      .def_prop_ro(
          "e_star_pa", [](const HarmonicResult& r) { return r.top.e_star_pa; },
          "|E*| [Pa], from the force on the top wall.")
      .def_prop_ro(
          "phase_deg", [](const HarmonicResult& r) { return r.top.phase_deg; },
          "Phase angle φ [degrees], from the force on the top wall.")
      .def_prop_ro(
          "modulus", [](const HarmonicResult& r) { return r.parts.modulus(); }, "Complex modulus E* [Pa].")
      .def_prop_ro(
          "bottom_e_star_pa", [](const HarmonicResult& r) { return r.bottom.e_star_pa; },
          "|E*| [Pa], from the force on the bottom wall; equal to e_star_pa without inertia.")
      .def_prop_ro(
          "bottom_phase_deg", [](const HarmonicResult& r) { return r.bottom.phase_deg; },
          "Phase angle φ [degrees], from the force on the bottom wall.")
      .def_prop_ro("shares", &fractions_of,
                   "Fraction of E* that each pair carries, by name; without inertia the sum is 1.")
      .def_prop_ro(
          "linear", [](const HarmonicResult& r) { return r.linear == LinearMethod::direct ? "direct" : "iterative"; },
          "Linear solver: iterative or direct.")
      .def_ro("why_factors", &HarmonicResult::why_factors,
              "Reason why the direct solver was used although it was not requested; else empty.")
      .def_ro("held_force", &HarmonicResult::held_force,
              "Force that holds free rigid motions over the reaction of the walls; only rounding in a correct "
              "solution.")
      .def_ro("residual", &HarmonicResult::residual, "Relative residual of the linear system.")
      .def_ro("iterations", &HarmonicResult::iterations, "Number of iterations of the linear solver.")
      .def_ro("seconds", &HarmonicResult::seconds, "Wall time of the solution [s].")
      .def_prop_ro(
          "motion",
          [](const HarmonicResult& r) {
            return view(r.motion.data(), {r.motion.size() / 6, 6});
          },
          "Complex displacement and rotation (ux uy uz θx θy θz) of each particle per unit displacement of the top "
          "wall, (n, 6).")
      .def_prop_ro(
          "pressures", [](const HarmonicResult& r) { return view(r.pressures.data(), {r.pressures.size()}); },
          "With rule \"volumetric\": complex pressure of each cell over 2μ per unit displacement of the top wall "
          "[1/m], positive in tension, (n,); otherwise empty.")
      .def("sensitivities", &sensitivities_of, nb::arg("specimen"),
           "Returns the change of |E*| [Pa] and φ [degrees] per unit of each parameter's natural logarithm, without "
           "inertia.");
  nb::class_<Solver>(m, "HarmonicSolver", "Steady states of one specimen at any number of frequencies.")
      .def(
          "__init__",
          [](Solver* self, PreparedPointer specimen, double typical_hz, const std::string& backend,
             const std::string& linear, const Devices& device, double tolerance) {
            new (self) Solver(std::move(specimen), typical_hz, choice("backend", backend, backends),
                              choice("linear", linear, linear_methods), device, tolerance);
          },
          nb::arg("specimen"), nb::arg("typical_hz") = 10.0, nb::arg("backend") = "cpu", nb::arg("linear") = "auto",
          nb::arg("device") = nb::none(), nb::arg("tolerance") = HarmonicOptions{}.tolerance)
      .def("solve", &Solver::solve, nb::arg("frequencies"), nb::arg("density_scaling") = 0.0,
           nb::arg("viscous_damping") = 0.0,
           "Returns the steady states at frequencies [Hz], (n,). density_scaling: factor on all densities; 0: without "
           "inertia. viscous_damping [1/s].");
  nb::class_<StartState>(m, "StartState", "Positions and velocities from which a stepped run starts.");
  m.def(
      "steady_start",
      [](const Prepared& p, const HarmonicResult& r, const drives::Cyclic& drive) {
        return steady_start(p.made.network, p.scene->laws, r.motion, drive);
      },
      nb::arg("specimen"), nb::arg("solution"), nb::arg("drive"),
      "Returns the state from which a stepped run is periodic from its first step on. `solution` must have the density "
      "scaling and damping of the run.");
}

}  // namespace macadam::python
