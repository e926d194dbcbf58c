// SPDX-License-Identifier: GPL-3.0-or-later
/// \file test_scenes.hpp  Random specimens with their networks, laws and masses; every seed gives another specimen.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <random>

#include "tests/support/long_tests.hpp"
#include "macadam/macadam.hpp"
#include "tests/support/test_networks.hpp"
#include "tests/support/test_spheres.hpp"

namespace macadam::test {

/// Returns the first seed of random specimens: the environment variable MACADAM_TEST_SEED, or 1.
inline unsigned test_seed() {
  const char* asked = std::getenv("MACADAM_TEST_SEED");
  return asked ? static_cast<unsigned>(std::strtoul(asked, nullptr, 10)) : 1;
}

/// Everything that a stepper needs except the options.
struct TestScene {
  Specimen specimen;
  ContactNetwork network;
  Laws laws;
  Inertia inertia;
};

/// Returns the AM1 laws of [1] (Table 4), one per pair type.
inline Laws am1_laws() {
  const auto mm = mastic_am1();
  laws::GeneralisedKelvin ma{3.511e10, 7.921e9, {1.197e9, 5.039e9, 1.357e11}, {2.819e10, 1.794e10, 3.510e9}, 0.10};
  Laws out;
  out[static_cast<std::size_t>(PairType::mm)] = mm;
  out[static_cast<std::size_t>(PairType::ma)] = ma;
  out[static_cast<std::size_t>(PairType::aa)] = laws::Elastic{1.151e11, 0.05};
  out[static_cast<std::size_t>(PairType::inner)] = laws::Elastic{1.125e11, 0.05};
  out[static_cast<std::size_t>(PairType::aw)] = laws::Elastic{1.151e11, 0.0};
  out[static_cast<std::size_t>(PairType::mw)] = laws::Elastic{3.511e10, 0.0};
  return out;
}

/// Returns one elastic law per pair type, softer than the laws of AM1's aggregates.
inline Laws elastic_laws() {
  Laws out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const double stiffer = 1 + static_cast<double>(pair);
    out[pair] = laws::Elastic{1e10 * stiffer, 0.05 * stiffer};
  }
  return out;
}

/// Returns the laws of binder AM2, one per pair type.
inline Laws am2_laws() {
  laws::GeneralisedKelvin ma{6.014e10, 7.859e9, {7.184e10, 4.270e10, 3.899e11}, {1.925e9, 3.959e9, 3.614e10}, 0.10};
  Laws out = am1_laws();
  out[static_cast<std::size_t>(PairType::mm)] = mastic_am2();
  out[static_cast<std::size_t>(PairType::ma)] = ma;
  out[static_cast<std::size_t>(PairType::mw)] = laws::Elastic{8.909e9, 0.0};
  return out;
}

/// Returns spheres of random size, shifted at random from a grid of nx × ny × nz cells of 2 mm. Every pair type occurs;
/// a pair of spheres makes up one aggregate.
inline Specimen random_specimen(unsigned seed, int nx = 4, int ny = 4, int nz = 5) {
  std::mt19937 random(seed);
  auto uniform = [&](double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(random()) / 4294967296.0); };
  const double cell = 2e-3;
  Specimen out;
  out.box.size = {nx * cell, ny * cell, nz * cell};
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        out.centre.push_back(
            {(x + uniform(0.3, 0.7)) * cell, (y + uniform(0.3, 0.7)) * cell, (z + uniform(0.3, 0.7)) * cell});
        out.radius.push_back(uniform(0.7e-3, 1.1e-3));
        const auto n = static_cast<std::int32_t>(out.size()) - 1;
        const bool aggregate = n % 3 != 0;
        out.phase.push_back(aggregate ? Phase::aggregate : Phase::mastic);
        out.body.push_back(aggregate ? n / 6 : -1);
      }
    }
  }
  return out;
}

/// Returns a random specimen with two large spheres in it, each of which touches about a hundred other spheres.
inline Specimen boulders(unsigned seed) {
  const double cell = 2e-3, radius = 3.1 * cell;
  const Specimen small = random_specimen(seed, 15, 9, 9);
  const Vec3d centres[] = {cell * Vec3d{4.3, 4.5, 4.5}, cell * Vec3d{10.7, 4.5, 4.5}};
  Specimen out;
  out.box = small.box;
  for (std::size_t i = 0; i < small.size(); ++i) {
    const auto is_near = [&](const Vec3d& c) { return norm(small.centre[i] - c) < radius + 0.8e-3; };
    if (std::ranges::none_of(centres, is_near))
      add(out, small.centre[i], small.radius[i], small.phase[i], small.body[i]);
  }
  auto body = static_cast<std::int32_t>(small.size());
  for (const Vec3d& c : centres) add(out, c, radius, Phase::aggregate, body++);
  return out;
}

/// Tessellates the specimen and returns it with its network, laws and masses.
inline TestScene make_scene(Specimen specimen, const NetworkSpec& spec = {}, const Laws& laws = am1_laws()) {
  TestScene out{std::move(specimen), {}, laws, {}};
  out.network = build_network(out.specimen, tessellate(out.specimen), spec);
  out.inertia = make_inertia(out.specimen, 2630, 2110);
  return out;
}

/// Returns options with a stable time step and a top wall that oscillates at 2 kHz, fast enough to move all particles
/// within 1,000 steps.
inline StepperOptions shaking_options(const TestScene& scene) {
  StepperOptions out;
  const double dt = 0.5 * critical_step(scene.network, scene.laws, scene.inertia, out).dt;
  drives::Cyclic loading;
  loading.amplitude = 1e-4 * scene.specimen.box.size.z;
  loading.frequency = 2000;
  loading.steps_per_period = static_cast<std::int64_t>(1 / (loading.frequency * dt)) + 1;
  loading.ramp_steps = 100;
  out.boundary = moving_top(loading);
  out.dt = loading.dt();
  return out;
}

/// Returns the cyclic drive of the top wall.
inline drives::Cyclic top_drive(const StepperOptions& options) {
  return dynamic_cast<const drives::Cyclic&>(*options.boundary.wall[wall_index(wall_z_hi)].axis[2].drive);
}

/// Returns shaking_options() with a load of 100 Hz, so that a backend may take many steps per update of the
/// viscoelastic state.
inline StepperOptions slow_options(const TestScene& scene) {
  StepperOptions out = shaking_options(scene);
  drives::Cyclic loading = top_drive(out);
  loading.frequency = 100;
  loading.steps_per_period = static_cast<std::int64_t>(1 / (loading.frequency * out.dt)) + 1;
  out.boundary = moving_top(loading);
  out.dt = loading.dt();
  return out;
}

/// Returns the largest length in a list of vectors.
inline double largest(const std::vector<Vec3d>& list) {
  double out = 0;
  for (const auto& v : list) out = std::max(out, norm(v));
  return out;
}

/// Returns the largest difference between two lists of vectors, divided by the largest length in the second list.
inline double relative_difference(const std::vector<Vec3d>& list, const std::vector<Vec3d>& expected) {
  double out = list.size() == expected.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double d = norm(list[i] - expected[i]);
    out = std::isnan(d) ? INFINITY : std::max(out, d);
  }
  return out / largest(expected);
}

/// Returns the backends besides the reference that this build and machine can run. With MACADAM_REQUIRE_GPU=1, CUDA is
/// in the list even without a device, so that tests fail.
inline std::vector<Backend> tested_backends() {
  std::vector<Backend> out{Backend::cpu};
  const char* required = std::getenv("MACADAM_REQUIRE_GPU");
  if (!report_backends().devices.empty() || (required && std::string(required) == "1")) out.push_back(Backend::cuda);
  return out;
}

}  // namespace macadam::test
