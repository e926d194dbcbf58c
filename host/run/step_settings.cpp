// SPDX-License-Identifier: GPL-3.0-or-later
// step_settings.cpp  Converts `[solver]` into stepper options, and writes the settings used to summary.json.
#include "host/run/step_settings.hpp"

#include <fmt/format.h>

#include "macadam/error.hpp"

namespace macadam {

ContactForm form_of(const Scene& scene) {
  bool by_points = scene.network.quadrature == Quadrature::one_point;
  for (const auto& law : facts_of(scene.laws)) by_points = by_points || (law && !law->linear);
  return scene.solver.form.value_or(by_points ? ContactForm::points : ContactForm::condensed);
}

StepperOptions stepper_options(const SolverSpec& solver, ContactForm form, Geometry geometry, Precision precision) {
  StepperOptions options;
  options.form = form;
  options.geometry = geometry;
  options.precision = precision;
  options.damping_kind = solver.damping_kind;
  options.damping = solver.damping;
  options.threads = solver.threads;
  options.devices = solver.devices;
  options.side_by_side = solver.side_by_side;
  options.ranks = ranks();
  return options;
}

std::unique_ptr<Stepper> stepper_from(const std::vector<StateArray>& state, Backend backend, const Scene& scene,
                                      const Preparation& prepared, const Inertia& inertia,
                                      const StepperOptions& options, std::unique_ptr<Stepper> used) {
  auto stepper =
      make_stepper(backend, prepared.specimen, prepared.network, scene.laws, inertia, options, std::move(used));
  if (!state.empty()) stepper->set_state(state);
  return stepper;
}

void require_possible(double steps, double dt, const std::string& what) {
  constexpr double most = 1e12;
  if (steps < most) return;  // written so that a NaN is refused too
  throw RunError(fmt::format(
      "with the time step of {:.6g} s the run would take {:.6g} steps {}; increase density_scaling", dt, steps, what));
}

std::string keys_of_steps(const SolverSpec& solver) {
  std::vector<const char*> out;
  if (solver.density_scaling) out.push_back("density_scaling");
  if (solver.safety) out.push_back("safety");
  if (solver.time_step) out.push_back("time_step");
  if (solver.damping_given) out.push_back("damping");
  if (solver.form) out.push_back("form");
  return fmt::format("{}", fmt::join(out, ", "));
}

void add_increment_settings(const experiments::Stepped& found, const RunResult& run, nlohmann::ordered_json& solver) {
  for (const char* key : {"dt_s", "steps"}) solver.erase(key);
  solver["precision"] = to_string(found.precision);
  solver["form"] = to_string(found.form);
  solver["geometry"] = to_string(found.geometry);
  solver["decisions"] = run.decisions;
  solver["bytes"] = found.bytes;
}

void add_settings(const experiments::Stepped& found, const Scene& scene, const RunResult& run, std::int64_t steps,
                  std::optional<double> dt_s, nlohmann::ordered_json& solver) {
  if (dt_s) solver["dt_s"] = *dt_s;
  solver["steps"] = steps;
  solver["precision"] = to_string(found.precision);
  solver["form"] = to_string(found.form);
  solver["geometry"] = to_string(found.geometry);
  solver["damping"] = {{"kind", to_string(scene.solver.damping_kind)}, {"value", scene.solver.damping}};
  solver["decisions"] = run.decisions;
  solver["critical_particle"] = found.critical_particle;
  solver["critical_dt_s"] = found.critical_dt_s;
  solver["bytes"] = found.bytes;
}

}  // namespace macadam
