// SPDX-License-Identifier: GPL-3.0-or-later
// simulation.cpp  Binds `macadam run`: runs a scene's experiment and writes its files into a folder.
#include "macadam/simulation.hpp"

#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "macadam/macadam.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/fields.hpp"

namespace macadam::python {
namespace {

/// The state of a run at one step, which the callback on_step receives. After the callback has returned, reading
/// particles or contacts raises an error, because the run has continued.
class StepView {
 public:
  StepView(const Stepper& stepper, const Preparation& made, double frequency_hz)
      : stepper_(&stepper), made_(&made), frequency_hz(frequency_hz), now(stepper.observe()) {}
  /// Makes later calls of stepper() raise an error.
  void end() { stepper_ = nullptr; }

  const Stepper& stepper() const {
    if (!stepper_)
      throw RunError("step: found a use after the callback had returned, expected uses only within the callback");
    return *stepper_;
  }
  double strain() const { return now.top_displacement() / height_; }
  double stress() const { return -now.top_force() / area_; }
  ContactState contacts() const { return stepper().contacts(made_->network); }
  nb::ndarray<nb::numpy, float> cell_stress() const { return stress_of(*made_, contacts()); }

 private:
  const Stepper* stepper_;
  const Preparation* made_;
  double height_ = gauge_length(made_->specimen);
  double area_ = section_area(made_->specimen);

 public:
  double frequency_hz;
  Observation now;
};

/// Returns the watcher that calls Python's callbacks during a run. `started` becomes true when the run is planned. From
/// then on the run itself asks stop(), so that it writes its checkpoint if it is interrupted. `made` is set to the
/// specimen as soon as the specimen is prepared.
Watcher watcher_of(LongCall& call, bool& started, const Preparation*& made, const nb::object& on_step,
                   std::int64_t every, const nb::object& on_plan, const nb::object& on_warning) {
  Watcher w;
  w.progress = [&](const std::string& stage, double fraction) {
    if (started) {
      call.show(stage, fraction);
    } else {
      call.progress(stage, fraction);
    }
  };
  w.prepared = [&](const Preparation& p) { made = &p; };
  w.planned = [&](const RunResult& planned) {
    started = true;
    if (!on_plan.is_none()) call.call_python([&] { on_plan(planned.decisions); });
  };
  if (!on_warning.is_none()) w.warn = [&](const std::string& text) { call.call_python([&] { on_warning(text); }); };
  w.stop = [&] { return call.stop(); };
  if (on_step.is_none()) return w;
  w.every = every;
  w.stepped = [&](const Stepper& stepper, double hz) {
    const auto seen = std::make_shared<StepView>(stepper, *made, hz);
    call.call_python([&] {
      const nb::object object = nb::cast(seen);
      try {
        on_step(object);
      } catch (...) {
        seen->end();
        throw;
      }
    });
    seen->end();
  };
  return w;
}

/// Runs the scene's experiment. specimen: a specimen that was made before, or null to make one from the scene. every:
/// number of steps between two calls of on_step.
std::shared_ptr<RunResult> run_scene(const GivenScene& scene, const std::filesystem::path& out,
                                     const PreparedPointer& specimen, bool resume, const nb::object& on_step,
                                     std::int64_t every, const nb::object& progress, const nb::object& on_plan,
                                     const nb::object& on_warning) {
  if (every < 1)
    throw InputError("every: found " + std::to_string(every) + ", expected a whole number of steps from 1 on");
  LongCall call(progress);
  bool started = false;
  const Preparation* made = nullptr;
  const Watcher watcher = watcher_of(call, started, made, on_step, every, on_plan, on_warning);
  const GivenScene copy = scene;  // another Python thread may change the caller's scene
  return call([&] {
    return std::make_shared<RunResult>(specimen ? run(copy, specimen->made, out, watcher, resume)
                                                : run(copy, out, watcher, resume));
  });
}

nb::list skips_of(const RunResult& result) {
  nb::list out;
  for (const Skip& skip : result.skips) {
    nb::dict one;
    one["what"] = skip.what;
    one["why"] = skip.why;
    one["effect"] = skip.effect;
    out.append(one);
  }
  return out;
}

}  // namespace

void bind_simulation(nb::module_& m) {
  nb::class_<StepView>(m, "Step", "State of a run at one step, for a callback.")
      .def("__repr__",
           [](const StepView& s) {
             return fmt::format("<macadam.Step: step {}, {:.6g} s, strain {:.4g}, stress {:.4g} Pa>", s.now.step,
                                s.now.time, s.strain(), s.stress());
           })
      .def_ro("frequency_hz", &StepView::frequency_hz, "Frequency of a cyclic test [Hz]; 0 for other tests.")
      .def_prop_ro("step", [](const StepView& s) { return s.now.step; })
      .def_prop_ro(
          "time", [](const StepView& s) { return s.now.time; }, "Time [s].")
      .def_prop_ro("strain", &StepView::strain, "Strain of the specimen, tension positive.")
      .def_prop_ro("stress_pa", &StepView::stress, "Stress on the top wall [Pa], tension positive.")
      .def_ro("observation", &StepView::now, "Displacements and forces of all walls.")
      .def(
          "particles", [](const StepView& s) { return s.stepper().particles(); },
          "Returns the present motion of all particles.")
      .def("contacts", &StepView::contacts, "Returns present forces and deformation of all contacts.")
      .def("stress", &StepView::cell_stress,
           "Returns the mean stress in each particle's cell [Pa], (n, 6): xx yy zz xy yz xz, tension positive.");
  nb::class_<RunResult>(m, "Outcome", "A finished run. Its numbers are in summary.json in the folder.")
      .def_prop_ro("text", &results_table, "Results as the command prints them.")
      .def_prop_ro("decisions", [](const RunResult& o) { return o.decisions; })
      .def_prop_ro("skips", [](const RunResult& o) { return skips_of(o); })
      .def_prop_ro("warnings", [](const RunResult& o) { return o.warnings; })
      .def_prop_ro("solver", [](const RunResult& o) { return o.solver; })
      .def_prop_ro("backend", [](const RunResult& o) { return to_string(o.backend); });
  m.def("run", &run_scene, nb::arg("scene"), nb::arg("out"), nb::arg("specimen").none() = nb::none(),
        nb::arg("resume") = false, nb::arg("on_step") = nb::none(), nb::arg("every") = 1000,
        nb::arg("progress") = nb::none(), nb::arg("on_plan") = nb::none(), nb::arg("on_warning") = nb::none());
}

}  // namespace macadam::python
