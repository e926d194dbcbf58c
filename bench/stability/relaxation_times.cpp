// SPDX-License-Identifier: GPL-3.0-or-later
// relaxation_times.cpp  Tests laws whose relaxation times are far below and far above the time step.
#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/format.h>

#include "bench/stability/stability.hpp"

namespace macadam::stability {
namespace {

using Complex = std::complex<double>;
constexpr double modulus = 1e10;
constexpr std::int64_t per_cycle = 100;
constexpr const char* alternating = "alternating part of the force after 1000 steps / η·v";

/// Returns one particle that is too heavy to move, with the top wall pulling at its only contact. The force of the
/// stepper then depends on the law alone.
test::TestScene one_contact(const laws::GeneralisedKelvin& law) {
  test::HandMade made;
  const double edge = 2e-3;
  made.specimen.box.size = {edge, edge, edge};
  test::add_particle(made, {edge / 2, edge / 2, edge / 2}, edge / 2, 1e30, Phase::mastic);
  test::add_square_contact(made.network, 0, wall_z_hi, PairType::mw, {0, 0, 1}, edge / 2, 0, edge);
  test::fill_rows(made.network, 1);
  return {made.specimen, made.network, test::same_law(law), made.inertia};
}

/// Returns the complex stiffness of the springs and dashpots under the trapezoidal rule, which replaces iω by
/// i·(2/Δt)·tan(ωΔt/2). It follows from x = f/E_m + ∫f/C_m + Σ x_l, C_l·ẋ_l + E_l·x_l = f.
Complex discrete_stiffness(const laws::GeneralisedKelvin& law, double dt) {
  const Complex rate(0, 2 / dt * std::tan(std::numbers::pi / per_cycle));
  Complex compliance = 1 / law.E_m + 1.0 / (rate * law.C_m);
  for (std::size_t l = 0; l < law.E.size(); ++l) compliance += 1.0 / (law.E[l] + rate * law.C[l]);
  return 1.0 / compliance;
}

/// `ramp_cycles`: number of cycles of the smooth start. `smooth_start`: bound for the error of E* that the start leaves
/// if the force alternates from step to step without dying out. The alternation is caused by the curvature of the
/// velocity at the beginning of the start, which is proportional to (π/2R)² for a start of R steps. The fit of one
/// cycle of n steps turns an alternating signal of size 1 into an error of 8.0/n (4.9/n without the second harmonic).
/// For a fit without the second harmonic the bound is 2·1.5·(π/2R)²/n; here it is multiplied by 8.0/4.9.
constexpr std::int64_t ramp_cycles = 10;
constexpr double smooth_start =
    2 * 1.5 * 2.4674 * (8.0 / 4.9) / (ramp_cycles * per_cycle * ramp_cycles * per_cycle) / per_cycle;

/// Checks a sudden start of a Maxwell unit with τ far below the time step. In each step the trapezoidal rule multiplies
/// the deviation of the force f from η·v by −(1 − 2τ/Δt)/(1 + 2τ/Δt). f should equal η·v immediately but starts from 0,
/// so it alternates about η·v for Δt/4τ steps.
void ringing(Rows& rows, double dt) {
  for (const double tau : {1e-6, 1e-4, 1e-2}) {
    const auto scene = one_contact({modulus, modulus * tau * dt, {}, {}, 0});
    drives::Cyclic loading;
    loading.amplitude = 1e-6;
    loading.steps_per_period = per_cycle;
    loading.frequency = 1 / (dt * static_cast<double>(per_cycle));
    StepperOptions options;
    options.dt = loading.dt();
    options.geometry = Geometry::fixed;
    options.boundary = moving_top(loading);
    constexpr int steps = 1000;
    const Contact& contact = scene.network.contacts[0];
    const double flow = modulus * tau * dt * contact.area / contact.length * 2 * std::numbers::pi * loading.frequency *
                        loading.amplitude;
    const double kept = std::pow((1 - 2 * tau) / (1 + 2 * tau), steps);
    for (const Setting& setting : settings()) {
      const auto stepper = make(setting, scene, options);
      stepper->advance(steps - 1);
      double f[3];
      for (double& value : f) {
        value = stepper->observe().top_force();
        stepper->advance(1);
      }
      rows.push_back({fmt::format("Maxwell unit, {:.0e} steps, sudden start", tau), setting.name(), alternating,
                      kept - 0.01, kept + 0.01,
                      "((1 − 2τ/Δt)/(1 + 2τ/Δt))^1000: the rule is stable, but a sudden start rings for Δt/4τ steps",
                      std::abs(f[2] - 2 * f[1] + f[0]) / 4 / flow});
    }
  }
}

}  // namespace

Rows relaxation_times(Effort effort) {
  Rows rows;
  const double dt = 1e-6;
  struct Chain {
    std::string name;
    double maxwell;              ///< C_m/E_m in steps
    std::vector<double> kelvin;  ///< C_l/E_l in steps
  };
  std::vector<Chain> chains;
  for (const double steps : {1e-6, 1e-4, 1e-2, 1e0, 1e2, 1e4, 1e6}) {
    chains.push_back({fmt::format("Maxwell and Kelvin unit, {:.0e} steps", steps), steps, {steps}});
  }
  chains.push_back({"1e-6, 1 and 1e6 steps in one chain", 1e6, {1e-6, 1, 1e6}});
  const auto most = by_effort<std::int64_t>(effort, 100'000, 400'000, 10'000'000);
  for (const Chain& chain : chains) {
    laws::GeneralisedKelvin law{modulus, modulus * chain.maxwell * dt, {}, {}, 0};
    double slowest = chain.maxwell, fastest = chain.maxwell;
    for (const double steps : chain.kelvin) {
      law.E.push_back(modulus / 2);
      law.C.push_back(modulus / 2 * steps * dt);
      slowest = std::max(slowest, steps), fastest = std::min(fastest, steps);
    }
    const auto scene = one_contact(law);
    drives::Cyclic loading;
    loading.amplitude = 1e-6;
    loading.steps_per_period = per_cycle;
    loading.frequency = 1 / (dt * static_cast<double>(per_cycle));
    loading.ramp_steps = ramp_cycles * per_cycle;
    StepperOptions options;
    options.dt = loading.dt();
    options.geometry = Geometry::fixed;
    options.boundary = moving_top(loading);
    // The effect of the start has two parts. One decays with the slowest relaxation time; the fit removes its offset
    // and trend, so only its curvature remains. The other belongs to a τ below the time step and decays as (1 −
    // 4τ/Δt)^k; the smooth start hardly excites it.
    const double memory = std::max({slowest, 1 / fastest, 10.0});
    const std::int64_t cycles = std::min(most, static_cast<std::int64_t>(40 * memory)) / per_cycle + 20;
    const double settled = static_cast<double>(cycles * per_cycle);
    const double rest = std::exp(-settled / slowest) * std::pow(per_cycle / slowest, 2);
    const double walk = std::sqrt(settled);
    const Complex k = discrete_stiffness(law, options.dt);
    const Stiffness expected{std::abs(k), std::arg(k) * 180 / std::numbers::pi};
    for (const Setting& setting : settings()) {
      if (setting.backend == Backend::cuda && effort != Effort::full) continue;
      const auto stepper = make(setting, scene, options);
      const Stiffness found =
          evaluate_cyclic(last_cycle(*stepper, scene.specimen, loading, cycles), loading.frequency, 1).fit;
      // the box holds a single contact, so stress over strain is f/x times (box height / contact distance)
      const double scale = scene.network.contacts[0].distance / scene.specimen.box.size.z;
      const bool mixed = setting.precision == Precision::mixed;
      rows.push_back(
          {chain.name, setting.name(), fmt::format("difference of E* from the closed form, {} cycles", cycles), 0,
           (mixed ? 4 * setting.rounding() : 20 * setting.rounding() * walk) + rest +
               (fastest < 1e-2 ? smooth_start : 0),
           mixed ? "the rule turns iω into i·(2/Δt)·tan(ωΔt/2), exactly; velocities round to single"
                 : "the rule turns iω into i·(2/Δt)·tan(ωΔt/2), exactly; rounding of displacement and force walks",
           stiffness_difference({found.e_star_pa * scale, found.phase_deg}, expected)});
    }
  }
  ringing(rows, dt);
  return rows;
}

}  // namespace macadam::stability
