// SPDX-License-Identifier: GPL-3.0-or-later
// strain_amplitudes.cpp  Measures up to which strain, from 1e-6 to 1e-2, fixed geometry is accurate enough.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bench/stability/stability.hpp"

namespace macadam::stability {
namespace {

constexpr double strains[] = {1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2};
constexpr const char* crossing_modulus = "strain at which E* of `fixed` is off by 1e-5";
constexpr const char* crossing_stress = "strain at which stresses of `fixed` are off by 1e-3 of the amplitude (rms)";

/// Returns the strain at which a curve of differences first reaches `level`, by logarithmic interpolation; infinity if
/// it never does.
double first_reaching(const std::vector<double>& difference, double level) {
  for (std::size_t i = 1; i < difference.size(); ++i) {
    if (difference[i] < level) continue;
    const double share = std::log(level / difference[i - 1]) / std::log(difference[i] / difference[i - 1]);
    return strains[i - 1] * std::pow(strains[i] / strains[i - 1], share);
  }
  return INFINITY;
}

}  // namespace

Rows strain_amplitudes(Effort effort) {
  Rows rows;
  auto scene =
      test::make_scene(generated_specimen(3, by_effort(effort, 30, 40, 120)), {}, test::same_law(quick_law(1)));
  drives::Cyclic loading;
  loading.steps_per_period = by_effort<std::int64_t>(effort, 2000, 2000, 10000);
  loading.ramp_steps = loading.steps_per_period;
  const double dt = 0.5 * critical_step(scene.network, scene.laws, scene.inertia, {}).dt;
  loading.frequency = 1 / (dt * static_cast<double>(loading.steps_per_period));
  scene.laws = test::same_law(quick_law(dt * static_cast<double>(loading.steps_per_period) / 2000 / 3));
  const Stiffness harmonic = harmonic_solution(scene, loading.frequency, 1).top;
  const double phase_step = 2 * std::numbers::pi / static_cast<double>(loading.steps_per_period);

  for (const Setting& setting : settings()) {
    if (effort != Effort::full && setting.precision != Precision::double_) continue;
    // rounding adds up like a random walk, with about ten rounding errors of the contact geometry per step
    const double rounding = 10 * setting.rounding() * std::sqrt(4.0 * static_cast<double>(loading.steps_per_period));
    std::vector<double> of_modulus, of_stress;
    Stiffness smallest, largest;  // E* with fixed geometry
    for (const double strain : strains) {
      StepperOptions options;
      loading.amplitude = strain * scene.specimen.box.size.z;
      options.dt = loading.dt();
      options.boundary = moving_top(loading);
      std::vector<ResponseSample> samples[2];
      for (const Geometry geometry : {Geometry::fixed, Geometry::updated}) {
        options.geometry = geometry;
        const auto stepper = make(setting, scene, options);
        auto& own = samples[geometry == Geometry::updated];
        own = last_cycle(*stepper, scene.specimen, loading, 4);
        if (strain != strains[0]) continue;
        rows.push_back(
            {fmt::format("strain {:.0e}, `{}` against the harmonic solution with inertia", strain, to_string(geometry)),
             setting.name(), "difference of E*", 0, phase_step * phase_step + rounding,
             "small strain is linear; stepping errs by (ωΔt)²/12, and the start has died out",
             stiffness_difference(fundamental(own), harmonic)});
      }
      const Stiffness fixed = fundamental(samples[0]), updated = fundamental(samples[1]);
      if (strain == strains[0]) smallest = fixed;
      largest = fixed;
      of_modulus.push_back(stiffness_difference(fixed, updated));
      double square = 0;
      for (std::size_t k = 1; k < samples[0].size(); ++k) {
        square += std::pow(samples[0][k].stress_pa - samples[1][k].stress_pa, 2) / 100;
      }
      of_stress.push_back(std::sqrt(square) / (strain * updated.e_star_pa));
      const std::string name = fmt::format("strain {:.0e}, `fixed` against `updated`", strain);
      rows.push_back({name, setting.name(), "rms of the difference of stress / amplitude", 0, 5 * strain + rounding,
                      "normals, levers and distances change by the strain, forces by a few times that",
                      of_stress.back()});
      rows.push_back(
          {name, setting.name(), "difference of E*", 0, 5 * strain * strain * 10 + rounding,
           "odd terms of the strain cancel over a whole cycle: second order, with a coefficient of about ten",
           of_modulus.back()});
    }
    rows.push_back({"`fixed` at strain 1e-2 against 1e-6", setting.name(), "difference of E*", 0, 1e-12 + rounding,
                    "`fixed` is linear: rounding alone", stiffness_difference(largest, smallest)});
    rows.push_back({"`fixed` against `updated`", setting.name(), crossing_stress, 2e-4, INFINITY,
                    "five times the strain at most (above): not below 2e-4", first_reaching(of_stress, 1e-3)});
    rows.push_back({"`fixed` against `updated`", setting.name(), crossing_modulus, std::sqrt(1e-5 / 50), INFINITY,
                    "fifty times the strain squared at most (above)", first_reaching(of_modulus, 1e-5)});
  }
  return rows;
}

}  // namespace macadam::stability
