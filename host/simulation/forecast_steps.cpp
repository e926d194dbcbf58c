// SPDX-License-Identifier: GPL-3.0-or-later
// forecast_steps.cpp  Predicts the time steps and the frequency-domain solutions of a run. Applies the rules for
// planning the run, but to numbers that are known without a specimen.
#include "host/simulation/forecast_parts.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "host/run/error_model.hpp"
#include "host/experiments/cyclic/step_rules.hpp"
#include "host/experiments/transient/load_rules.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/run/harmonic_options.hpp"
#include "macadam/harmonic.hpp"

namespace macadam {
namespace {

const Law* law_of(const Scene& scene, PairType pair) {
  const auto& law = scene.laws[static_cast<std::size_t>(pair)];
  return law ? &*law : nullptr;
}

double instantaneous(const Law& law) {
  return std::visit([](const auto& l) { return l.instantaneous(); }, law);
}

/// Returns the order of magnitude of the specimen's |E*| at a frequency [Pa]: the geometric mean of the contact moduli,
/// over the pair types that have most of the contacts.
double modulus_at(const Scene& scene, double hz) {
  const double omega = 2 * std::numbers::pi * hz;
  const auto logarithm = mean_of_usual(
      scene, [&](const Law& law, PairType pair) { return std::log(with_rock(scene, pair, stiffness_at(law, omega))); });
  return logarithm ? std::exp(*logarithm) : 1e9;
}

/// Returns the critical time step at true mass [s]: the critical step of the smallest spheres, with the stiffest law of
/// their contacts.
double critical_step(const Scene& scene, const Census& census) {
  constexpr double mastic_part = 0.377, cluster_part = 0.58;  // measured: critical step over radius·√(density/modulus)
  const auto step = [&](double part, double radius, double density, std::initializer_list<PairType> pairs) {
    double stiffest = 0;
    for (const PairType pair : pairs)
      if (const Law* law = law_of(scene, pair))
        stiffest = std::max(stiffest, with_rock(scene, pair, instantaneous(*law)));
    return stiffest > 0 && density > 0 && radius > 0 ? part * radius * std::sqrt(density / stiffest) : INFINITY;
  };
  const SpecimenSpec& s = scene.specimen;
  double mastic = census.smallest_mastic, aggregate = census.smallest_in_aggregates;
  if (s.mastic) mastic = s.mastic->radius_min;
  if (s.shapes)
    aggregate = s.shapes->fill.radius_min;
  else if (!s.aggregate.empty())
    aggregate = s.aggregate.back().sieve_min / 2;
  double out = step(mastic_part, mastic, scene.materials.mastic, {PairType::mm, PairType::ma});
  if (census.in_aggregates > census.aggregates)
    out = std::min(out, step(cluster_part, aggregate, scene.materials.aggregate, {PairType::inner}));
  else if (mastic == 0)
    out = step(mastic_part, aggregate, scene.materials.aggregate, {PairType::aa});
  return out;
}

StepForecast cyclic_steps(const Scene& scene, std::size_t k, double critical) {
  const experiments::Cyclic& test = scene.cyclic();
  const SolverSpec& solver = scene.solver;
  StepForecast out;
  out.frequency_hz = test.frequencies[k];
  if (const auto given = given_scaling(scene, k, critical)) {
    out.density_scaling = *given;
  } else {  // the error of inertia is estimated as a part of ρω²H²/|E*|; a run computes it
    constexpr double inertia_error = 0.3;
    const double density = std::max(scene.materials.mastic, scene.materials.aggregate);
    const double turn = 2 * std::numbers::pi * out.frequency_hz * gauge_length(scene.specimen.box);
    out.density_scaling =
        std::max(1.0, aimed_part * inertia_part * *solver.tolerance * modulus_at(scene, out.frequency_hz) /
                          (inertia_error * density * turn * turn));
  }
  const double step = longest_cyclic_step(solver, critical, out.density_scaling);
  const double of_period = steps_per_period(out.frequency_hz, step, test.samples_per_cycle);
  out.cycles = count_cycles(scene, cyclic_start(scene, cyclic_geometry(scene))).cycles;
  out.dt_s = 1 / (out.frequency_hz * of_period);
  out.steps = out.cycles * of_period;
  return out;
}

/// Returns the instantaneous modulus that the specimen would have if all contacts had the same strain [Pa]. Contacts
/// point in all directions, and the sum of their areas times distances is three times the volume of the box.
double affine_modulus(const Scene& scene) {
  const auto mean = mean_of_usual(scene, [&](const Law& law, PairType pair) {
    const double alpha = std::visit([](const auto& l) { return l.alpha; }, law);
    return with_rock(scene, pair, instantaneous(law)) * (0.6 + 0.4 * alpha);
  });
  return mean.value_or(1e9);
}

StepForecast load_steps(const Scene& scene, double critical) {
  const TransientExperiment test = load_test_of(scene);
  StepForecast out;
  out.density_scaling = density_scaling_of(scene.solver, 0);
  const double density = out.density_scaling * std::max(scene.materials.mastic, scene.materials.aggregate);
  const double slowest = slowest_period(test, gauge_length(scene.specimen.box), affine_modulus(scene), density);
  const double ramp = ramp_of(test, slowest);
  const LoadDamping damping = damping_of(test, scene.solver, facts_of(scene.laws), ramp, slowest);
  out.dt_s = load_step(test, scene.solver, critical, out.density_scaling, ramp, damping);
  out.steps = std::round(test.history.times.back() / out.dt_s);
  return out;
}

/// Returns the contrast of the laws: the largest |k*(s)| of a law divided by the smallest. The number of iterations of
/// the solver grows with the cube root of the contrast.
double contrast_at(const LawTable& laws, std::complex<double> s) {
  double softest = INFINITY, stiffest = 0;
  for (const auto& law : laws) {
    if (!law) continue;
    const double k = std::visit(
        [&]<class L>(const L& l) {
          if constexpr (has_stiffness<L>)
            return std::abs(l.stiffness(s));
          else
            return l.instantaneous();
        },
        *law);
    softest = std::min(softest, k), stiffest = std::max(stiffest, k);
  }
  return softest > 0 && stiffest > 0 ? stiffest / softest : 1;
}

}  // namespace

std::vector<StepForecast> forecast_steps(const Scene& scene, const Census& census) {
  const double critical = critical_step(scene, census);
  std::vector<StepForecast> out;
  if (!std::holds_alternative<experiments::Cyclic>(scene.experiment)) return {load_steps(scene, critical)};
  for (std::size_t k = 0; k < scene.cyclic().frequencies.size(); ++k) out.push_back(cyclic_steps(scene, k, critical));
  return out;
}

std::vector<double> forecast_contrasts(const Scene& scene, bool stepped) {
  const std::vector<double> frequencies = frequencies_of(scene.experiment);
  std::vector<double> out;
  if (scene.solver.method == SolverMethod::quasi_static && !frequencies.empty()) {
    // Linear laws need one system per increment, and cracks about two more.
    const bool linear = !first_without_stiffness(scene.laws);
    constexpr double most = 1e7;  // a run refuses more increments
    const double all = (linear ? 1.0 : 3.0) * samples_by_increments(scene);
    const auto systems = static_cast<std::size_t>(std::min(all, most));
    for (const double f : frequencies)
      out.insert(out.end(), systems, contrast_at(scene.laws, {0, 2 * std::numbers::pi * f}));
    return out;
  }
  if (scene.solver.method == SolverMethod::quasi_static) {
    // A test takes some 100 increments with 3 linear systems each. A system takes about the time of a solution in the
    // frequency domain. It has real instead of complex numbers, but it is solved several times as cracks soften the
    // specimen.
    constexpr std::size_t systems = 300;
    out.assign(systems, contrast_at(scene.laws, 1 / load_test_of(scene).history.times.back()));
    return out;
  }
  if (first_without_stiffness(scene.laws)) return out;
  if (!frequencies.empty()) {
    if (stepped && !plans_with_solutions(scene)) return out;
    std::vector<LawTable> tables;  // one per temperature
    if (!stepped)
      for (const double t : temperatures_of(scene.experiment)) tables.push_back(laws_at(scene, t));
    if (tables.empty()) tables.push_back(scene.laws);
    for (const double f : frequencies)
      for (const LawTable& laws : tables) out.push_back(contrast_at(laws, {0, 2 * std::numbers::pi * f}));
    return out;
  }
  // A spectrum is computed from this number of solutions at real s, from a tenth of the inverse of the longest time to
  // ten times the inverse of the shortest time.
  constexpr int of_spectrum = 24;
  const std::vector<double> times = load_test_of(scene).history.times;
  const double low = std::log(0.1 / times.back()), high = std::log(10 / times.front());
  for (int i = 0; i < of_spectrum; ++i)
    out.push_back(contrast_at(scene.laws, std::exp(low + (high - low) * i / (of_spectrum - 1))));
  return out;
}

}  // namespace macadam
