// SPDX-License-Identifier: GPL-3.0-or-later
// step_limit.cpp  Tests time steps around the true limit 2/ω_max, and compares critical_step() with that limit.
#include <cmath>

#include <fmt/format.h>

#include "bench/stability/modes.hpp"
#include "bench/stability/stability.hpp"
#include "tests/support/cluster_specimens.hpp"

namespace macadam::stability {
namespace {

/// A combination of law, quadrature, form and geometry.
struct Variant {
  const char* name;
  bool am1;
  Quadrature quadrature;
  ContactForm form;
  Geometry geometry;
};

constexpr Variant variants[] = {
    {"elastic, lumped, condensed", false, Quadrature::lumped, ContactForm::condensed, Geometry::fixed},
    {"elastic, lumped, points", false, Quadrature::lumped, ContactForm::points, Geometry::fixed},
    {"elastic, exact, condensed", false, Quadrature::exact, ContactForm::condensed, Geometry::fixed},
    {"elastic, lumped, condensed, updated", false, Quadrature::lumped, ContactForm::condensed, Geometry::updated},
    {"AM1, lumped, condensed", true, Quadrature::lumped, ContactForm::condensed, Geometry::fixed},
};

/// Relative resolution of the bisection in onset().
constexpr double onset_resolution = 1e-3;

/// Returns the largest relative change of H, the energy that leapfrog keeps, over a run of an elastic network with
/// fixed geometry. The run starts from random velocities.
double energy_drift(const Setting& setting, const test::TestScene& scene, const Modes& modes,
                    const StepperOptions& options, std::int64_t steps) {
  const auto stepper = make(setting, scene, options);
  shake(*stepper, scene, 1e-3);
  const double start = modes.energy(stepper->particles(), options.dt);
  double drift = 0;
  for (int k = 0; k < 40; ++k) {
    stepper->advance(steps / 40);
    const double now = std::abs(modes.energy(stepper->particles(), options.dt) / start - 1);
    drift = now > drift || std::isnan(now) ? now : drift;
  }
  return drift;
}

/// Returns the logarithm of the factor by which the amplitude grows per step. `expected`: the expected value. The
/// measurement begins after 35 / `expected` steps, when the growing motion is much larger than all other motions.
double growth(const Setting& setting, const test::TestScene& scene, const StepperOptions& options, double expected) {
  const auto stepper = make(setting, scene, options);
  shake(*stepper, scene, 1e-3);
  const auto first = static_cast<std::int64_t>(35 / expected), second = static_cast<std::int64_t>(20 / expected);
  stepper->advance(first);
  const double before = kinetic_energy(scene, stepper->particles());
  stepper->advance(second);
  const double after = kinetic_energy(scene, stepper->particles());
  return 0.5 * std::log(after / before) / static_cast<double>(second);
}

/// Returns the largest time step without growth, as a fraction of the limit. It is found by bisection between 0.9 and
/// 1.1 times `expected`. A run counts as unstable if its kinetic energy has grown a thousandfold.
double onset(const Setting& setting, const test::TestScene& scene, StepperOptions options, double limit,
             double expected, std::int64_t steps) {
  double stable = 0.9 * expected, unstable = 1.1 * expected;
  while (unstable - stable > onset_resolution * expected) {
    const double middle = 0.5 * (stable + unstable);
    options.dt = middle * limit;
    const auto stepper = make(setting, scene, options);
    shake(*stepper, scene, 1e-3);
    const double start = kinetic_energy(scene, stepper->particles());
    stepper->advance(steps);
    const double end = kinetic_energy(scene, stepper->particles());
    (end < 1e3 * start ? stable : unstable) = middle;
  }
  return 0.5 * (stable + unstable);
}

}  // namespace

Rows step_sweep(Effort effort) {
  Rows rows;
  const auto steps = by_effort<std::int64_t>(effort, 1000, 1600, 50000);
  for (const Variant& v : variants) {
    NetworkSpec spec;
    spec.quadrature = v.quadrature;
    const auto scene = test::make_scene(test::random_specimen(5), spec, v.am1 ? test::am1_laws() : elastic_laws());
    const double limit = true_limit(scene);
    const bool linear = !v.am1 && v.geometry == Geometry::fixed;
    const auto modes = linear ? std::make_unique<Modes>(scene) : nullptr;
    StepperOptions options;
    options.form = v.form;
    options.geometry = v.geometry;
    for (const Setting& setting : settings()) {
      if (effort == Effort::test && setting.precision == Precision::mixed) continue;
      double worst = 0, worst_growth = 0, worst_drift = 0;
      for (const double share : {0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99}) {
        options.dt = share * limit;
        const double found = energy_over_bound(setting, scene, options, limit, steps);
        rows.push_back({fmt::format("{}, {} of the limit", v.name, share), setting.name(), "kinetic energy / bound", 0,
                        1 + 1e-3, "", found, true});
        worst = std::max(worst, found);
        if (!linear) continue;
        // `share`: time step / limit. Close to the limit the conserved energy H is a small difference of two large
        // terms: H ≥ (1 − share²) × kinetic energy. A rounding error of these terms is then a relative change of H that
        // is larger by up to 1/(1 − share²), so the change is multiplied by 1 − share².
        const double drift = energy_drift(setting, scene, *modes, options, steps) * (1 - share * share);
        worst_drift = drift > worst_drift || std::isnan(drift) ? drift : worst_drift;
      }
      rows.push_back({fmt::format("{}: 0.5 … 0.99 of 2/ω_max", v.name), setting.name(),
                      fmt::format("largest kinetic energy / bound, {} steps", steps), 0,
                      v.geometry == Geometry::updated ? 1.01 : 1 + 1e-3,
                      "leapfrog keeps H, which is at least (1 − (Δt·ω_max/2)²) × kinetic energy", worst});
      if (linear) {
        rows.push_back({fmt::format("{}: 0.5 … 0.99 of 2/ω_max", v.name), setting.name(),
                        fmt::format("largest (1 − (Δt·ω_max/2)²)·|H/H(0) − 1|, {} steps", steps), 0,
                        10 * setting.rounding() * std::sqrt(static_cast<double>(steps)),
                        "linear and without loss: H is kept exactly, a random walk of ten roundings per step",
                        worst_drift});
      }
      if (v.geometry == Geometry::updated) continue;  // growing motion leaves the linear range in which the rate holds
      for (const double share : {1.01, 1.02, 1.05, 1.1}) {
        options.dt = share * limit;
        const double expected = 2 * std::acosh(share);
        const double error = growth(setting, scene, options, expected) / expected - 1;
        rows.push_back({fmt::format("{}, {} of the limit", v.name, share), setting.name(), "growth rate error", -0.02,
                        0.02, "", error, true});
        if (!(std::abs(error) <= std::abs(worst_growth))) worst_growth = error;
      }
      rows.push_back({fmt::format("{}: 1.01 … 1.1 of 2/ω_max", v.name), setting.name(),
                      "growth a step / 2·arcosh(Δt·ω_max/2) − 1", -0.02, 0.02,
                      "the stiffest mode grows by e^(2·arcosh) a step; neighbouring modes, not yet outgrown, slow it",
                      worst_growth});
    }
  }
  for (const double chi : {0.1, 0.3, 0.7}) {
    const auto scene = test::make_scene(test::random_specimen(5), {}, elastic_laws());
    const double limit = true_limit(scene);
    StepperOptions options;
    options.geometry = Geometry::fixed;
    options.damping_kind = Damping::local;
    options.damping = chi;
    for (const Setting& setting : settings()) {
      if (effort == Effort::test && setting.precision == Precision::mixed) continue;
      const double expected = 1 / std::sqrt(1 + chi);
      options.dt = 0.99 * expected * limit;
      rows.push_back({fmt::format("elastic, lumped, local damping χ = {}: 0.99/√(1 + χ) of 2/ω_max", chi),
                      setting.name(), fmt::format("largest kinetic energy / bound, {} steps", steps), 0, 1 + 1e-3,
                      "opposed motion meets up to (1 + χ) × the force: the limit shortens by √(1 + χ), no more",
                      energy_over_bound(setting, scene, options, limit * expected, steps)});
      const double found = onset(setting, scene, options, limit, expected, steps);
      rows.push_back({fmt::format("elastic, lumped, local damping χ = {}", chi), setting.name(),
                      "onset of growth / (2/ω_max/√(1 + χ))", 1 - onset_resolution, 1.1,
                      "likewise; found by bisection to a thousandth", found / expected});
    }
  }
  return rows;
}

Rows step_bound(Effort effort) {
  Rows rows;
  double least = INFINITY, most = 0, sum = 0;
  constexpr int specimens = 20;
  const int particles = by_effort(effort, 27, 60, 120);
  for (int k = 0; k < specimens; ++k) {
    NetworkSpec spec;
    spec.quadrature = k % 2 == 0 ? Quadrature::lumped : Quadrature::exact;
    spec.lateral_walls = k % 3 == 0;
    const bool generated = k >= specimens / 2;
    const bool clusters = generated && (effort == Effort::test ? k == 16 : k % 3 == 1);
    const auto seed = static_cast<std::uint64_t>(900 + k);
    const auto scene =
        test::make_scene(clusters    ? test::few_clusters(seed)
                         : generated ? generated_specimen(seed, particles)
                                     : test::random_specimen(static_cast<unsigned>(seed), 3, 3, particles / 9),
                         spec, k % 4 < 2 ? test::am1_laws() : elastic_laws());
    const double share = critical_step(scene.network, scene.laws, scene.inertia, {}).dt / true_limit(scene);
    rows.push_back({fmt::format("specimen {}: {}, {} particles, {}, {}", k,
                                clusters    ? "clusters"
                                : generated ? "generated"
                                            : "jittered grid",
                                scene.specimen.size(), k % 2 == 0 ? "lumped" : "exact", k % 4 < 2 ? "AM1" : "elastic"),
                    "double", "computed / true limit", std::sqrt(0.5), 1 + 1e-12, "", share, true});
    least = std::min(least, share), most = std::max(most, share), sum += share;
  }
  const std::string unsafe = "ω_max² ≤ 2·max λ(M_i⁻¹·K_ii), since a contact's energy is at most twice its ends' own";
  const std::string loose = "moving one particle alone shows ω_max² ≥ max λ(M_i⁻¹·K_ii): the bound is within √2";
  rows.push_back({"20 specimens", "double", "largest computed / true limit", 0, 1 + 1e-12, unsafe, most});
  rows.push_back({"20 specimens", "double", "least computed / true limit", std::sqrt(0.5), 1, loose, least});
  rows.push_back(
      {"20 specimens", "double", "mean computed / true limit", std::sqrt(0.5), 1, "between the two", sum / specimens});
  return rows;
}

}  // namespace macadam::stability
