// SPDX-License-Identifier: GPL-3.0-or-later
// forecast.cpp  Sizes follow from the recipe; what they cost was measured: bench/forecast.
#include "host/simulation/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "host/experiments/stepped/cracks.hpp"
#include "host/experiments/stepped/settings.hpp"
#include "host/simulation/combination.hpp"
#include "host/simulation/costs.hpp"

namespace macadam {
namespace {

constexpr double usual_safety = 0.8, safety_by_tolerance = 0.95;

const Law* law_of(const Scene& scene, PairType pair) {
  const auto& law = scene.laws[static_cast<std::size_t>(pair)];
  return law ? &*law : nullptr;
}

double instantaneous(const Law& law) {
  return std::visit([](const auto& l) { return l.instantaneous(); }, law);
}

/// The mean of f(law) over the pairs that most contacts are of: those of the mastic, if there is any.
template <class F>
std::optional<double> mean_of_most(const Scene& scene, F&& f) {
  double sum = 0;
  int count = 0;
  for (const PairType pair : {PairType::mm, PairType::ma, PairType::inner, PairType::aa}) {
    if (count > 0 && pair > PairType::ma) break;
    if (const Law* law = law_of(scene, pair)) sum += f(*law), ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// Order of the specimen's |E*| at a frequency: the mean in the logarithm.
double modulus_at(const Scene& scene, double hz) {
  const auto logarithm = mean_of_most(scene, [hz](const Law& law) {
    return std::log(std::visit(
        [hz]<class L>(const L& l) {
          if constexpr (requires { l.stiffness(std::complex<double>()); })
            return std::abs(l.stiffness(std::complex<double>(0, 2 * std::numbers::pi * hz)));
          else
            return l.instantaneous();
        },
        law));
  });
  return logarithm ? std::exp(*logarithm) : 1e9;
}

/// Of a contact's step on the scene's backend.
StepCost step_cost(const Scene& scene, const Forecast& f) {
  constexpr int no_chain = -1;
  const auto of_law = [&](const auto& law) {
    const LawFacts facts = facts_of(law);
    return facts.memoryless && f.geometry == Geometry::fixed ? no_chain : facts.units;
  };
  const auto units = mean_of_most(scene, [&](const Law& law) { return std::visit(of_law, law); });
  return step_cost(f.backend == Backend::cuda, f.form, f.precision, f.geometry, units.value_or(0));
}

/// The critical step at true mass: that of a small sphere among the stiffest contacts it can have [s].
double critical_step(const Scene& scene, const Census& census) {
  constexpr double mastic_share = 0.377, cluster_share = 0.58;  // of radius·√(density/modulus), measured
  const auto step = [&](double share, double radius, double density, std::initializer_list<PairType> pairs) {
    double stiffest = 0;
    for (const PairType pair : pairs)
      if (const Law* law = law_of(scene, pair)) stiffest = std::max(stiffest, instantaneous(*law));
    return stiffest > 0 && density > 0 && radius > 0 ? share * radius * std::sqrt(density / stiffest) : INFINITY;
  };
  const SpecimenSpec& s = scene.specimen;
  double mastic = census.smallest_mastic, aggregate = census.smallest_in_aggregates;
  if (s.mastic) mastic = s.mastic->radius_min;
  if (s.shapes)
    aggregate = s.shapes->fill.radius_min;
  else if (!s.aggregate.empty())
    aggregate = s.aggregate.back().sieve_min / 2;
  double out = step(mastic_share, mastic, scene.materials.mastic, {PairType::mm, PairType::ma});
  if (census.in_aggregates > census.aggregates)
    out = std::min(out, step(cluster_share, aggregate, scene.materials.aggregate, {PairType::inner}));
  else if (mastic == 0)
    out = step(mastic_share, aggregate, scene.materials.aggregate, {PairType::aa});
  return out;
}

bool starts_steady(const Scene& scene, const experiments::Cyclic& test) {
  return test.start ? *test.start == Start::steady : scene.solver.tolerance.has_value();
}

/// Steps of a cyclic test: a whole number of samples a period.
StepForecast cyclic_steps(const Scene& scene, const experiments::Cyclic& test, std::size_t k, double critical) {
  StepForecast out;
  out.frequency_hz = test.frequencies[k];
  const SolverSpec& solver = scene.solver;
  const double omega = 2 * std::numbers::pi * out.frequency_hz, height = scene.specimen.box.size.z;
  if (solver.density_scaling) {
    out.density_scaling =
        solver.density_scaling->size() > 1 ? (*solver.density_scaling)[k] : solver.density_scaling->front();
  } else if (solver.tolerance) {
    // inertia's error is this share of ρω²L²/|E*|; 0.87 of the tolerance is spent on it
    constexpr double inertia_error = 0.3, spent = 0.87;
    const double density = std::max(scene.materials.mastic, scene.materials.aggregate);
    out.density_scaling = std::max(1.0, spent * *solver.tolerance * modulus_at(scene, out.frequency_hz) /
                                            (inertia_error * density * omega * omega * height * height));
  }
  const double safety = solver.safety.value_or(solver.tolerance ? safety_by_tolerance : usual_safety);
  const bool steady = starts_steady(scene, test);
  const int cycles = test.cycles.value_or(steady ? 1 : solver.tolerance ? 4 : 5);
  double dt = solver.time_step.value_or(safety * critical * std::sqrt(out.density_scaling));
  const double sample = 1 / (out.frequency_hz * test.samples_per_cycle);
  dt = sample / std::max(1.0, std::ceil(sample / dt));
  out.dt_s = dt;
  out.steps = std::round(cycles / (out.frequency_hz * dt));
  return out;
}

double end_of(const Experiment& experiment) {
  return std::visit(
      [](const auto& test) -> double {
        if constexpr (requires { test.times; }) return test.times.empty() ? 0 : test.times.back();
        return 0;
      },
      experiment);
}

std::vector<StepForecast> steps_of(const Scene& scene, const Census& census) {
  const double critical = critical_step(scene, census);
  std::vector<StepForecast> out;
  if (const auto* test = std::get_if<experiments::Cyclic>(&scene.experiment)) {
    for (std::size_t k = 0; k < test->frequencies.size(); ++k) out.push_back(cyclic_steps(scene, *test, k, critical));
  } else {
    StepForecast one;
    one.density_scaling = scene.solver.density_scaling ? scene.solver.density_scaling->front() : 1;
    one.dt_s = scene.solver.time_step.value_or(scene.solver.safety.value_or(usual_safety) * critical *
                                               std::sqrt(one.density_scaling));
    one.steps = end_of(scene.experiment) / one.dt_s;
    out.push_back(one);
  }
  return out;
}

int solutions_of(const Scene& scene, bool stepped) {
  const auto temperatures = std::max<std::size_t>(1, temperatures_of(scene.experiment).size());
  const auto frequencies = frequencies_of(scene.experiment).size();
  // a spectrum asks for solutions at real s, some five a decade of time
  constexpr int of_spectrum = 24;
  if (stepped) return static_cast<int>(scene.solver.tolerance ? frequencies : 0);
  return frequencies > 0 ? static_cast<int>(frequencies * temperatures) : of_spectrum;
}

std::vector<std::string> skips_of(const Scene& scene, bool stepped, Geometry geometry) {
  std::vector<std::string> out;
  if (stepped && geometry == Geometry::fixed) out.push_back("geometry update");
  if (!scene.network.lateral_walls) out.push_back("lateral walls");
  if (!scene.output.response) out.push_back("response.csv");
  if (!scene.output.contacts) out.push_back("contacts.csv");
  return out;
}

std::vector<std::string> files_of_run(const Scene& scene) {
  std::vector<std::string> out{"summary.json", "specimen.csv"};
  if (!scene.specimen.file) out.push_back("aggregates.csv");
  if (scene.recipe) out.push_back("gradation.csv");
  for (const std::string& file : files_of(scene.experiment)) {
    const bool response = file == "response.csv";
    if (response && (!scene.output.response || scene.solver.method == SolverMethod::harmonic)) continue;
    out.push_back(file);
  }
  if (counts_cracks(scene)) out.push_back(cracks_file);
  if (scene.output.contacts) out.push_back("contacts.csv");
  if (scene.output.fields.any()) out.push_back("fields/");
  return out;
}

void add_memory(const Scene& scene, Forecast& f, const Cost& cost) {
  const bool device = f.backend == Backend::cuda;
  const StepCost step = f.stepped ? step_cost(scene, f) : StepCost{};
  // what solutions take is given back before the steps
  const double solved = f.solutions == 0 ? 0 : device ? cost.a_solved_contact_beside_device : cost.a_solved_contact;
  const auto* cyclic = std::get_if<experiments::Cyclic>(&scene.experiment);
  const bool steady = cyclic && starts_steady(scene, *cyclic);
  const double staged = cost.staged * (step.bytes - step.chain) + (steady ? cost.staged_chain * step.chain : 0);
  const double beside = std::max(solved, device ? staged : step.bytes);
  f.host_bytes = cost.program + (device ? cost.driver : 0) + cost.a_shape * static_cast<double>(f.census.templates) +
                 (cost.a_contact + beside) * f.contacts;
  if (device)
    f.device_bytes =
        cost.device + std::max(step.bytes, f.solutions > 0 ? cost.a_solved_contact_on_device : 0) * f.contacts;
}

void add_time(const Scene& scene, Forecast& f, const Cost& cost) {
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
  f.harmonic_s = f.solutions * std::pow(n, 4.0 / 3) * (device ? cost.solving_on_device : cost.solving / threads);
  double rate = step_cost(scene, f).seconds;
  if (device && f.contacts < cost.contacts_on_chip) rate *= cost.on_chip;
  if (!device && f.contacts < cost.contacts_in_cache) rate *= cost.cached;
  const double step = device ? std::max(cost.least_step_on_device, rate * f.contacts) : rate * f.contacts / threads;
  for (const StepForecast& s : f.steps) f.stepping_s += s.steps * step;
}

}  // namespace

Forecast forecast(const Scene& scene) {
  require_combination(scene);
  const Cost cost;
  Forecast out;
  out.backend = select_backend(scene.solver.backend, &out.reason, scene.solver.devices);
  out.threads = scene.solver.threads > 0 ? scene.solver.threads : report_backends().threads;
  out.census = count_specimen(scene.specimen);
  const double n = static_cast<double>(out.census.particles());
  const bool single_spheres = !scene.specimen.shapes && !scene.specimen.aggregate.empty() && scene.specimen.mastic;
  const double inside = single_spheres ? cost.contacts_of_single_spheres : cost.contacts;
  out.contacts = std::max(0.0, n * (inside - cost.missing_at_sides / std::cbrt(std::max(1.0, n))));
  out.stepped = scene.solver.method == SolverMethod::explicit_;
  out.form = form_of(scene);
  // a tolerance lets the program take the geometry of the start and the least precision, where these cost little
  const bool chosen = out.stepped && scene.solver.tolerance.has_value();
  out.geometry = scene.solver.geometry.value_or(chosen ? Geometry::fixed : Geometry::updated);
  out.precision = scene.solver.precision.value_or(chosen ? Precision::single : Precision::double_);
  if (out.stepped) out.steps = steps_of(scene, out.census);
  out.solutions = solutions_of(scene, out.stepped);
  out.skips = skips_of(scene, out.stepped, out.geometry);
  out.files = files_of_run(scene);
  add_memory(scene, out, cost);
  add_time(scene, out, cost);
  return out;
}

}  // namespace macadam
