// SPDX-License-Identifier: GPL-3.0-or-later
// cycles_test.cpp  Tests cyclic loads by increments without inertia: linear specimens that start in the steady state of
// the frequency domain.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/quasi_static/quasi_static_stepper.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/results.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

constexpr double frequency = 5;  ///< [Hz]

HarmonicResult steady_state(const TestScene& scene) {
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, frequency);
  return harmonic.solve(std::vector{HarmonicLoad{frequency, 0, 0}}).front();
}

/// Takes a cycle in `samples` increments from the steady state, and returns |E*| and φ.
Stiffness cycle(const TestScene& scene, const HarmonicResult& known, int samples) {
  const Vec3d size = scene.specimen.box.size;
  constexpr std::int64_t units = 1000;
  drives::Cyclic loading(1e-4 * size.z, frequency, units * samples);
  quasi_static::CourseOptions options;
  options.height = size.z, options.area = size.x * size.y;
  options.tolerance = 0.1;  // the samples, not the control of errors, determine the increments
  options.first = units;
  for (int k = 1; k <= samples; ++k) options.stops.push_back(k * units);
  QuasiStaticStepper stepper(scene.specimen, scene.network, scene.laws, moving_top(loading), options);
  drives::Cyclic fine = loading;
  fine.steps_per_period = 1'000'000'000;
  stepper.start(steady_start(scene.network, scene.laws, known.motion, fine));
  std::vector<ResponseSample> found;
  for (int k = 0; k <= samples; ++k) {
    if (k > 0) stepper.advance(units);
    const Observation now = stepper.observe();
    found.push_back({frequency, now.time, now.top_displacement() / size.z, -now.top_force() / (size.x * size.y)});
  }
  EXPECT_EQ(stepper.report().increments, samples);
  return evaluate_cyclic(found, frequency, 1).fit;
}

// The trapezoidal rule shifts the frequency by the part (2π/n)²/12, so a linear specimen has at most this relative
// error of |E*| and this error of φ. Four times as many increments have a sixteenth of the error.
TEST(QuasiStaticCycles, HaveTheModulusOfTheFrequencyDomain) {
  const TestScene scene = make_scene(random_specimen(4));
  const HarmonicResult known = steady_state(scene);
  double before = 0;
  for (const int samples : {40, 160}) {
    const Stiffness found = cycle(scene, known, samples);
    const double bound = std::pow(2 * std::numbers::pi / samples, 2) / 12;
    const double modulus = found.e_star_pa / known.top.e_star_pa - 1;
    const double phase = (found.phase_deg - known.top.phase_deg) * std::numbers::pi / 180;
    EXPECT_LT(std::abs(modulus), bound);
    EXPECT_LT(std::abs(phase), bound);
    const double error = std::hypot(modulus, phase);
    EXPECT_GT(error, 1e-3 * bound);  // there is an error that can fall
    if (before > 0) { EXPECT_NEAR(error / before, 1.0 / 16, 0.02); }
    before = error;
  }
}

// The stress at the start is that of the steady state: −A·|E*|·sin(2πft + φ) at t = 0.
TEST(QuasiStaticCycles, StartInTheSteadyState) {
  const TestScene scene = make_scene(random_specimen(4));
  const HarmonicResult known = steady_state(scene);
  QuasiStatic q(scene.specimen, scene.network, scene.laws);
  const Vec3d size = scene.specimen.box.size;
  q.start(steady_start(scene.network, scene.laws, known.motion, {1e-4 * size.z, frequency, 1'000'000'000}));
  const double want = -1e-4 * known.top.e_star_pa * std::sin(known.top.phase_deg * std::numbers::pi / 180);
  const double stress = -q.wall_force()[wall_index(wall_z_hi)].z / (size.x * size.y);
  EXPECT_NEAR(stress, want, 1e-6 * std::abs(want));  // the residual of the solution
  StartState other;
  other.chain = {1, 2, 3};
  EXPECT_THROW(q.start(other), InputError);
}

}  // namespace
}  // namespace macadam::test
