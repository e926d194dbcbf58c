// SPDX-License-Identifier: GPL-3.0-or-later
// long_runs.cpp  Measures the drift of energy, momenta and |E*| over 1e8 steps of two particles and 1e7 steps of a
// hundred.
#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/format.h>

#include "bench/stability/modes.hpp"
#include "bench/stability/stability.hpp"
#include "tests/support/cluster_specimens.hpp"

namespace macadam::stability {
namespace {

constexpr const char* energy_change = "largest |energy / initial energy − 1|";

/// Runs a free elastic assembly, and compares energy, linear and angular momentum with their initial values.
void free_run(Rows& rows, const std::string& name, const test::TestScene& scene, const Modes& modes,
              const Setting& setting, Geometry geometry, std::int64_t steps) {
  StepperOptions options;
  options.geometry = geometry;
  options.dt = 0.8 * critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  const auto stepper = make(setting, scene, options);
  const double speed = 1e-3;
  shake(*stepper, scene, speed);
  ParticleState state = stepper->particles();
  modes.remove_rigid_part(state.velocity, state.spin);
  stepper->set_velocities(state.velocity, state.spin);
  stepper->advance(1);
  state = stepper->particles();
  const double energy = modes.energy(state, options.dt);
  const bool displaced = geometry == Geometry::updated;
  const Momenta before = momenta(scene, state, displaced);
  double drift = 0;
  for (int k = 0; k < 20; ++k) {
    stepper->advance(steps / 20);
    state = stepper->particles();
    const double now = std::abs(modes.energy(state, options.dt) / energy - 1);
    drift = now > drift || std::isnan(now) ? now : drift;
  }
  const Momenta after = momenta(scene, state, displaced);

  const std::string run =
      fmt::format("{}, free, elastic, {}, {:.0e} steps", name, to_string(geometry), static_cast<double>(steps));
  const double particles = static_cast<double>(scene.specimen.size());
  const double walk = std::sqrt(static_cast<double>(steps));
  const double eps = setting.rounding();
  // strain of the fastest motion, which is about the angle by which the geometry turns
  const double strain = 10 * speed * options.dt / 1e-3;
  rows.push_back({run, setting.name(), energy_change, 0, 10 * eps * walk + (displaced ? 10 * strain : 0),
                  displaced ? "geometry turns by angles of the order of the strain, to and fro: bounded, no drift"
                            : "leapfrog keeps H exactly: a random walk of ten roundings per step",
                  drift});
  const double momentum = speed * *std::max_element(scene.inertia.mass.begin(), scene.inertia.mass.end());
  const double double_walk = 2 * (setting.precision == Precision::single ? eps : 0x1p-53) * walk * std::sqrt(particles);
  rows.push_back({run, setting.name(), "linear momentum gained / momentum of one particle", 0, double_walk,
                  "a contact's two forces are each other's opposite: only velocities round, a random walk",
                  norm(after.linear - before.linear) / momentum});
  rows.push_back({run, setting.name(), "angular momentum gained / momentum of one particle across the box", 0,
                  2 * eps * walk * std::sqrt(particles),
                  "moments balance to the rounding of levers and frames, a random walk",
                  norm(after.angular - before.angular) / (momentum * norm(scene.specimen.box.size))});
}

/// Runs a loaded specimen, and compares E* of a late cycle with that of an early cycle and with the expected value.
void driven_run(Rows& rows, const std::string& name, const test::TestScene& scene, const Setting& setting,
                const drives::Cyclic& loading, std::int64_t steps, const Stiffness& expected, double tolerance,
                const char* reason) {
  StepperOptions options;
  options.geometry = Geometry::fixed;
  options.dt = loading.dt();
  options.boundary = moving_top(loading);
  const auto stepper = make(setting, scene, options);
  const std::int64_t cycles = steps / loading.steps_per_period;
  // the first cycle that is evaluated: after the ramp and 50 times the law's relaxation time of 300 steps
  const std::int64_t first = std::max(20000 / loading.steps_per_period, cycles / 20);
  const Stiffness early = fundamental(last_cycle(*stepper, scene.specimen, loading, first));
  const Stiffness late = fundamental(last_cycle(*stepper, scene.specimen, loading, cycles - first));
  const std::string run = fmt::format("{}, cyclic, {:.0e} steps, {} cycles", name, static_cast<double>(steps), cycles);
  const double eps = setting.rounding();
  const double drift = setting.precision == Precision::double_ ? 1e-10
                       : setting.precision == Precision::mixed ? 1e-6
                                                               : eps * std::sqrt(static_cast<double>(steps)) * 10;
  rows.push_back({run, setting.name(), "change of E* from the early run to its end", 0, drift,
                  setting.precision == Precision::single
                      ? "single states round every step: a random walk of ten roundings"
                      : "a steady state: the rounding of a cycle decays in a few hundred steps",
                  stiffness_difference(late, early)});
  rows.push_back({run, setting.name(), "difference of E* from the expected at the end", 0, tolerance + drift, reason,
                  stiffness_difference(late, expected)});
}

/// Returns the exact E* of two particles between the walls, a chain wall – 1 – 2 – wall along z. At a frequency ω the
/// trapezoidal rule and leapfrog exactly replace iω by i·(2/Δt)·tan(ωΔt/2) in the law and ω² by ((2/Δt)·sin(ωΔt/2))² in
/// the inertia. The top reaction then follows in closed form from two linear equations.
Stiffness column_stiffness(const test::TestScene& scene, const laws::GeneralisedKelvin& law,
                           const drives::Cyclic& loading) {
  using Complex = std::complex<double>;
  const double dt = loading.dt(), half = std::numbers::pi / static_cast<double>(loading.steps_per_period);
  const Complex rate(0, 2 / dt * std::tan(half));
  const Complex modulus = 1.0 / (1 / law.E_m + 1.0 / (rate * law.C_m) + 1.0 / (law.E[0] + rate * law.C[0]));
  const double edge = scene.specimen.box.size.x, inertia = scene.inertia.mass[0] * std::pow(2 / dt * std::sin(half), 2);
  // stiffness E·A/d: A/d = edge²/edge between particles, edge²/(edge/2) at a wall
  const Complex between = modulus * edge, wall = 2.0 * between;
  // (wall + between − inertia)·u₂ − between·u₁ = wall·w, and the same for u₁ with right-hand side 0
  const Complex own = wall + between - inertia;
  const Complex upper = wall * own / (own * own - between * between);
  const Complex reaction = wall * (1.0 - upper);  // reaction of the top wall per displacement w
  const Complex e_star = reaction * scene.specimen.box.size.z / (edge * edge);
  return {std::abs(e_star), std::arg(e_star) * 180 / std::numbers::pi};
}

/// Returns the number of steps for a setting: `steps` in double precision on the CPU. On CUDA it is a hundredth of
/// `steps`, because a launch takes longer than a small step on the CPU. In single precision it is a tenth, because
/// drift shows sooner.
std::int64_t steps_of(const Setting& setting, std::int64_t steps) {
  if (setting.backend == Backend::cuda) return steps / 100;
  return setting.precision == Precision::single ? steps / 10 : steps;
}

std::int64_t steps_of_two(Effort effort) { return by_effort<std::int64_t>(effort, 100'000, 500'000, 100'000'000); }
std::int64_t steps_of_hundred(Effort effort) { return by_effort<std::int64_t>(effort, 32'000, 48'000, 10'000'000); }

}  // namespace

Rows long_free(Effort effort) {
  Rows rows;
  test::PairShape shape;
  shape.s0 = 0.2e-3;
  shape.n = {0.6, 0, 0.8};
  const test::HandMade made = test::two_sphere_network(shape);
  const test::TestScene pair{made.specimen, made.network, elastic_laws(), made.inertia};
  NetworkSpec no_walls;
  no_walls.bottom_top_walls = false;
  const auto hundred = test::make_scene(test::random_specimen(40, 5, 5, 4), no_walls, elastic_laws());
  test::Laws stiff_inside = elastic_laws();
  stiff_inside[static_cast<std::size_t>(PairType::inner)] = laws::Elastic{3e12, 0.3};
  const auto clusters = test::make_scene(test::few_clusters(40), no_walls, stiff_inside);
  const Modes pair_modes(pair), hundred_modes(hundred), cluster_modes(clusters);
  const std::int64_t of_two = steps_of_two(effort), of_hundred = steps_of_hundred(effort);
  for (const Setting& setting : settings()) {
    free_run(rows, "two particles", pair, pair_modes, setting, Geometry::fixed, steps_of(setting, of_two));
    if (setting.precision == Precision::double_) {
      free_run(rows, "two particles", pair, pair_modes, setting, Geometry::updated, steps_of(setting, of_two / 10));
      free_run(rows, "a hundred particles", hundred, hundred_modes, setting, Geometry::fixed,
               steps_of(setting, of_hundred));
    } else {
      free_run(rows, "a hundred particles", hundred, hundred_modes, setting, Geometry::fixed,
               steps_of({setting.backend, Precision::single}, of_hundred));
    }
    free_run(rows, "clusters, inner contacts a hundred times as stiff", clusters, cluster_modes, setting,
             Geometry::fixed, steps_of({setting.backend, Precision::single}, of_hundred));
  }
  return rows;
}

Rows long_driven(Effort effort) {
  Rows rows;
  test::HandMade stack = test::cubic_lattice_network(1, 1, 2, 2e-3, 2e-5);
  test::TestScene column{stack.specimen, stack.network, test::same_law(quick_law(1)), stack.inertia};
  auto hundred = test::make_scene(test::random_specimen(40, 5, 5, 4), {}, test::same_law(quick_law(1)));
  for (test::TestScene* scene : {&column, &hundred}) {
    drives::Cyclic loading;
    loading.steps_per_period = scene == &column ? 1000 : 4000;
    loading.ramp_steps = loading.steps_per_period;
    loading.amplitude = 1e-6 * scene->specimen.box.size.z;
    const double dt = 0.5 * critical_step(scene->network, scene->laws, scene->inertia, {}).dt;
    loading.frequency = 1 / (dt * static_cast<double>(loading.steps_per_period));
    const auto law = quick_law(dt);
    scene->laws = test::same_law(law);
    const double phase_step = 2 * std::numbers::pi / static_cast<double>(loading.steps_per_period);
    const Stiffness expected =
        scene == &column ? column_stiffness(*scene, law, loading) : harmonic_solution(*scene, loading.frequency, 1).top;
    for (const Setting& setting : settings()) {
      if (scene == &column) {
        driven_run(rows, "two particles", *scene, setting, loading, steps_of(setting, steps_of_two(effort)), expected,
                   1e-10, "closed form of the column with the rule's own ω in law and inertia");
      } else {
        driven_run(rows, "a hundred particles", *scene, setting, loading,
                   std::max<std::int64_t>(32'000, steps_of(setting, steps_of_hundred(effort))), expected,
                   phase_step * phase_step, "the harmonic solution with inertia; stepping errs by (ωΔt)²/12");
      }
    }
  }
  return rows;
}

}  // namespace macadam::stability
