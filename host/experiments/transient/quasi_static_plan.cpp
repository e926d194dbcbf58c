// SPDX-License-Identifier: GPL-3.0-or-later
// quasi_static_plan.cpp  Chooses the settings of a test by increments from the times of the scene.
#include "host/experiments/transient/quasi_static_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/run/step_settings.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Smallest number of units of time in a test. Its points or its ramp may require more.
constexpr double units_of_test = 1e6;
/// Smallest numbers of units of time before the first point of the result, and in a ramp.
constexpr double units_before_first = 1e4, units_of_ramp = 1e3;
/// In a test whose load grows, the first increment is this fraction of the test.
constexpr double first_increment = 2e-4;
/// Largest number of passes of Newton's method if each one takes many iterations: a shorter increment is then faster.
constexpr int passes_with_iterations = 12;

/// Returns a sentence about the effects of a changing temperature.
std::string temperature_words(const TemperatureHistory& history, const Scene& scene) {
  const auto [coldest, warmest] = std::minmax_element(history.temperatures.begin(), history.temperatures.end());
  const bool shifts = std::any_of(scene.shifts.begin(), scene.shifts.end(), [](const laws::Shift& shift) {
    return !std::holds_alternative<laws::NoShift>(shift);
  });
  return fmt::format("the temperature is {:g} to {:g} degrees C; {}; {}", *coldest, *warmest,
                     scene.materials.expansion.any()
                         ? fmt::format("aggregates expand by {:g} and mastic by {:g} per kelvin",
                                       scene.materials.expansion.aggregate, scene.materials.expansion.mastic)
                         : "nothing expands, because [materials] gives no expansion",
                     shifts ? "each law with a shift relaxes in its reduced time"
                            : "relaxation times do not change, because no law has a shift");
}

bool is_sudden(const TransientExperiment& test) { return !test.grows && test.when.ramp == 0; }

}  // namespace

LoadPlan make_quasi_static_plan(const TransientExperiment& test, const Scene& scene, const Preparation& prepared) {
  if (scene.solver.geometry == Geometry::updated) {
    throw InputError(scene.file.string(), 0, "geometry with method \"quasi_static\"", "\"updated\"",
                     "\"fixed\", or method = \"explicit\"");
  }
  LoadPlan plan;
  const bool cracks = can_crack(facts_of(scene.laws));
  plan.form = cracks ? ContactForm::points : ContactForm::condensed;
  plan.geometry = Geometry::fixed;
  plan.critical.particle = -1;
  const double end = test.history.times.back(), first = test.history.times.front();
  double largest = std::min(end / units_of_test, first / units_before_first);
  if (!is_sudden(test) && !test.grows) largest = std::min(largest, test.when.ramp / units_of_ramp);
  require_possible(end / largest, largest, fmt::format("until {:g} s", end));
  const double ramp = test.grows ? end : test.when.ramp > 0 ? test.when.ramp : largest;
  plan.dt = test.step ? test.step(largest) : ramp / std::ceil(ramp / largest);
  plan.ramp = ramp;
  if (test.grows && !test.reverses) {
    // a constant rate: the unit divides the whole test
    plan.dt = end / std::ceil(end / largest);
  }
  const auto decide = [&](std::string text) { plan.decisions.push_back(std::move(text)); };
  if (!scene.solver.method_given) {
    decide(
        "method \"quasi_static\" (increments without inertia), because contacts can crack and the scene asks for "
        "neither inertia nor damping; method = \"explicit\" in [solver] takes time steps instead");
  }
  if (const std::string unused = keys_of_steps(scene.solver); !unused.empty())
    decide(fmt::format("not used: {} in [solver], because increments have no inertia and no time step", unused));
  if (!test.temperature.empty()) decide(temperature_words(test.temperature, scene));
  if (is_sudden(test)) {
    decide(fmt::format("the load grows within {:.3g} s, because the scene asks for an instantaneous load", ramp));
  }
  decide(
      fmt::format("increments are chosen so that the estimated error of each one is below {:g} of the largest {}; {}",
                  scene.solver.tolerance.value_or(1e-3), test.by_stress ? "strain" : "stress",
                  QuasiStaticOptions{}.solves_directly(prepared.specimen.size())
                      ? "the linear systems of the increments are solved by factorisation"
                      : "the linear systems of the increments are solved by iterations"));
  return plan;
}

quasi_static::CourseOptions course_options(const TransientExperiment& test, const LoadPlan& plan, const Scene& scene,
                                           const Preparation& prepared) {
  quasi_static::CourseOptions out;
  out.grows = test.grows && !test.reverses;
  out.height = gauge_length(prepared.specimen);
  out.area = section_area(prepared.specimen);
  out.tolerance = scene.solver.tolerance.value_or(out.tolerance);
  const auto add_kink = [&](double time) {
    const std::int64_t step = std::llround(time / plan.dt);
    if (step > 0) out.kinks.push_back(step);
  };
  if (!test.grows) add_kink(plan.ramp);
  if (test.when.release) add_kink(*test.when.release), add_kink(*test.when.release + plan.ramp);
  for (const double jump : test.jumps) add_kink(jump);
  for (const double corner : test.temperature.times) {
    if (corner < test.history.times.back()) add_kink(corner);
  }
  out.temperature = test.temperature;
  out.shifts = scene.shifts;
  if (!test.temperature.empty() && scene.materials.expansion.any())
    out.solver.expansion = free_openings(prepared.network, prepared.specimen, scene.materials.expansion);
  for (const double time : test.history.times) out.stops.push_back(plan.step_at(time));
  out.stops.insert(out.stops.end(), out.kinks.begin(), out.kinks.end());
  for (auto* list : {&out.stops, &out.kinks}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  const std::int64_t end = plan.step_at(test.history.times.back());
  double begin = first_increment * static_cast<double>(end);
  if (!test.grows) begin = std::min(begin, 0.02 * plan.ramp / plan.dt);
  out.first = is_sudden(test) ? 1 : std::max<std::int64_t>(1, std::llround(begin));
  // large systems are solved by iterations, and every digit of the solution costs the same time
  if (!out.solver.solves_directly(prepared.specimen.size())) {
    out.solver.residual = std::min(1e-6, 1e-3 * out.tolerance);
    if (out.grows && !out.by_force) out.solver.passes = passes_with_iterations;
  }
  return out;
}

}  // namespace macadam
