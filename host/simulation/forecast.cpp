// SPDX-License-Identifier: GPL-3.0-or-later
// forecast.cpp  Computes the sizes of a run from its recipe, and time and memory from measured costs (bench/forecast).
#include "host/simulation/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiments/cyclic/step_rules.hpp"
#include "host/run/skips.hpp"
#include "host/run/step_settings.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "host/simulation/measured_costs.hpp"
#include "host/simulation/forecast_parts.hpp"
#include "host/tessellation/notches.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/thread_limit.hpp"

namespace macadam {
namespace {

/// Returns the cost of a step per contact on the scene's backend.
StepCost step_cost(const Scene& scene, const Forecast& f) {
  constexpr int no_chain = -1;
  const auto of_law = [&](const auto& law) {
    const LawFacts facts = facts_of(law);
    return facts.memoryless && f.geometry == Geometry::fixed ? no_chain : facts.units;
  };
  const auto units = mean_of_usual(scene, [&](const Law& law, PairType) { return std::visit(of_law, law); });
  return step_cost(f.backend == Backend::cuda, f.form, f.precision, f.geometry, units.value_or(0));
}

/// Returns the names of the parts that the run leaves out.
std::vector<std::string> skips_of(const Scene& scene, bool stepped, Geometry geometry) {
  std::vector<std::string> out;
  if (stepped)
    for (const Skip& skip : geometry_skips(geometry, {})) out.push_back(skip.what);
  for (const Skip& skip : asked_skips(scene)) out.push_back(skip.what);
  return out;
}

/// Returns whether the direct solver is used. If the scene leaves this open, it is used when the contrast of stiffness
/// or the number of particles is so large that the iterative solver does not converge.
bool is_factored(const Scene& scene, const Forecast& f, double contrast) {
  const auto n = f.census.particles();
  if (scene.solver.linear != LinearMethod::automatic) return scene.solver.linear == LinearMethod::direct;
  return contrast * static_cast<double>(n) > Cost{}.iterable && n <= static_cast<std::int64_t>(largest_direct);
}

/// Returns the bytes that the direct solver takes.
double factor_bytes(double particles, const Cost& cost) { return cost.factors * std::pow(particles, 4.0 / 3); }

/// Returns the time of all solutions in the frequency domain [s].
double solution_seconds(const Scene& scene, const Forecast& f, const std::vector<double>& contrasts, const Cost& cost) {
  const double n = static_cast<double>(f.census.particles());
  const bool device = f.backend == Backend::cuda;
  const double usual = std::pow(n, 4.0 / 3) * (device ? cost.solving_on_device : cost.solving / f.threads);
  const double factoring = cost.factoring * std::pow(n, 1.5), iteration = cost.with_factors * factor_bytes(n, cost);
  double out = 0;
  for (const double contrast : contrasts) {
    const double longer = std::max(1.0, cost.by_contrast * std::cbrt(contrast));
    if (scene.solver.linear != LinearMethod::direct) out += usual * longer;
    if (!is_factored(scene, f, contrast)) continue;
    out += factoring + iteration * (scene.solver.linear == LinearMethod::direct ? 10 : cost.factored_iterations);
  }
  return out;
}

/// Adds the memory of host and device to the forecast.
void add_memory(const Scene& scene, Forecast& f, const std::vector<double>& contrasts, const Cost& cost) {
  const bool device = f.backend == Backend::cuda;
  const StepCost step = f.stepped ? step_cost(scene, f) : StepCost{};
  // the memory of the frequency-domain solutions is freed before the time steps begin, so the larger of both counts
  const double solved = f.solutions == 0 ? 0 : device ? cost.a_solved_contact_beside_device : cost.a_solved_contact;
  const bool cyclic = f.stepped && std::holds_alternative<experiments::Cyclic>(scene.experiment);
  const bool steady = cyclic && cyclic_start(scene, f.geometry) == Start::steady;
  const double staged = cost.staged * (step.bytes - step.chain) + (steady ? cost.staged_chain * step.chain : 0);
  const double beside = std::max(solved, device ? staged : step.bytes);
  const bool factored =
      std::any_of(contrasts.begin(), contrasts.end(), [&](double c) { return is_factored(scene, f, c); });
  const double factors = factored ? factor_bytes(static_cast<double>(f.census.particles()), cost) : 0;
  f.host_bytes = cost.program + (device ? cost.driver : 0) + cost.a_shape * static_cast<double>(f.census.templates) +
                 cost.a_contact * f.contacts + std::max(beside * f.contacts, solved * f.contacts + factors);
  if (device)
    f.device_bytes =
        cost.device + std::max(step.bytes, f.solutions > 0 ? cost.a_solved_contact_on_device : 0) * f.contacts;
}

/// Adds the times to the forecast.
void add_time(const Scene& scene, Forecast& f, const std::vector<double>& contrasts, const Cost& cost) {
  const double n = static_cast<double>(f.census.particles()), threads = f.threads;
  const bool device = f.backend == Backend::cuda;
  f.specimen_s = device ? cost.start_on_device : cost.start;
  if (!scene.specimen.file) {
    f.specimen_s += (cost.relaxing / threads + cost.placing) * n;
    if (const auto& shapes = scene.specimen.shapes) {
      const bool packed = shapes->placement == PlacementMethod::packing;
      f.specimen_s += (packed ? cost.packing : cost.inserting) * static_cast<double>(f.census.aggregates) / threads;
      if (packed) f.specimen_s += cost.packed_shape * static_cast<double>(f.census.templates) / threads;
    }
  }
  f.network_s = (cost.tessellating / threads + cost.joining) * n;
  f.harmonic_s = solution_seconds(scene, f, contrasts, cost);
  double rate = step_cost(scene, f).seconds;
  if (device && f.contacts < cost.contacts_on_chip) rate *= cost.on_chip;
  if (!device && f.contacts < cost.contacts_in_cache) rate *= cost.cached;
  const double step = device ? std::max(cost.least_step_on_device, rate * f.contacts) : rate * f.contacts / threads;
  for (const StepForecast& s : f.steps) f.stepping_s += s.steps * step;
  f.writing_s = cost.writing * f.disk_bytes() + cost.frame * f.field_frames;
}

}  // namespace

Forecast forecast(const Scene& scene) {
  require_combination(scene);
  const ThreadLimit threads(scene.solver.threads);
  const Cost cost;
  Forecast out;
  out.backend = select_backend(requested_backend(scene), &out.reason, scene.solver.devices);
  out.threads = scene.solver.threads > 0 ? scene.solver.threads : report_backends().threads;
  out.census = count_specimen(scene.specimen);
  checked_notches(scene.specimen.box, scene.network.notches);
  for (const auto& more : {law_range_warnings(scene), scene.specimen.merged})
    out.census.warnings.insert(out.census.warnings.end(), more.begin(), more.end());
  const double n = static_cast<double>(out.census.particles());
  const bool single_spheres = !scene.specimen.shapes && !scene.specimen.aggregate.empty() && scene.specimen.mastic;
  const double inside = single_spheres ? cost.contacts_of_single_spheres : cost.contacts;
  out.contacts = std::max(0.0, n * (inside - cost.missing_at_sides / std::cbrt(std::max(1.0, n))));
  out.stepped = scene.solver.method == SolverMethod::explicit_;
  out.form = form_of(scene);
  const bool cyclic = std::holds_alternative<experiments::Cyclic>(scene.experiment);
  out.geometry = cyclic ? cyclic_geometry(scene) : scene.solver.geometry.value_or(Geometry::updated);
  // with a tolerance a run takes the lowest precision whose error is small; the forecast assumes single precision
  const bool chosen = out.stepped && scene.solver.tolerance.has_value();
  out.precision = scene.solver.precision.value_or(chosen ? Precision::single : Precision::double_);
  if (out.stepped) out.steps = forecast_steps(scene, out.census);
  const std::vector<double> contrasts = forecast_contrasts(scene, out.stepped);
  out.solutions = static_cast<int>(contrasts.size());
  out.skips = skips_of(scene, out.stepped, out.geometry);
  forecast_files(scene, out);
  add_memory(scene, out, contrasts, cost);
  add_time(scene, out, contrasts, cost);
  return out;
}

}  // namespace macadam
