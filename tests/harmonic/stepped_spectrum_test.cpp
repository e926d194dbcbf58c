// SPDX-License-Identifier: GPL-3.0-or-later
// stepped_spectrum_test.cpp  Steps relaxation, creep and recovery in time with driven walls. Compares them with the
// spectrum, which is computed without time steps.
#include <gtest/gtest.h>

#include "tests/support/long_tests.hpp"
#include "macadam/spectrum.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

class SteppedSpectrum : public testing::Test {
 protected:
  TestScene scene_ = make_scene(read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}}));
  double height_ = scene_.specimen.box.size.z;
  double area_ = scene_.specimen.box.size.x * scene_.specimen.box.size.y;
  Spectrum spectrum_ = spectrum_of(scene_.specimen, scene_.network, scene_.laws, {1e-4, 10});

  /// Returns options with viscous damping β [1/s], which damps the waves that a ramp causes. Damping changes slow
  /// motion by far less than 1e-4.
  StepperOptions options(double scaling, double beta) const {
    StepperOptions out;
    out.geometry = Geometry::fixed;
    out.density_scaling = scaling;
    out.damping_kind = Damping::viscous;
    out.damping = beta;
    return out;
  }
  std::unique_ptr<Stepper> make(const StepperOptions& options) const {
    return make_stepper(Backend::cpu, scene_.specimen, scene_.network, scene_.laws, scene_.inertia, options);
  }
  double step(const StepperOptions& options) const {
    return 0.8 * critical_step(scene_.network, scene_.laws, scene_.inertia, options).dt;
  }

  /// The strain rises linearly for the time `rise` and is then held. Compares the ratio of stress to strain between the
  /// times `from` and `to` with the spectrum's response to such a ramp. All times in seconds.
  void expect_relaxation(double scaling, double beta, double rise, double from, double to) const {
    StepperOptions given = options(scaling, beta);
    given.dt = rise / std::ceil(rise / step(given));
    const double strain = 1e-5;
    const auto rise_steps = std::llround(rise / given.dt);
    given.boundary = moving_top(drives::Ramp(strain * height_, given.dt, rise_steps));
    const auto stepper = make(given);
    const auto first = std::llround(from / given.dt), every = std::llround((to - from) / 20 / given.dt);
    stepper->advance(first);
    sample(*stepper, every, 20, [&](const Observation& now) {
      const double modulus = -now.top_force() / area_ / strain;
      EXPECT_NEAR(modulus / spectrum_.relaxation.after_ramp(now.time, rise), 1, 1e-4) << now.time << " s";
    });
  }
};

// The first case is a ramp of 0.2 ms at true mass, the second a slow ramp with scaled inertia.
TEST_F(SteppedSpectrum, IsTheRelaxation) {
  EXPECT_LT(spectrum_.error, 1e-5);
  expect_relaxation(1, 2e4, 2e-4, 1e-3, long_tests ? 5e-3 : 2e-3);
  expect_relaxation(1000, 2e3, 5e-2, 0.1, long_tests ? 1.0 : 0.2);
}

// The stress on the platen (a wall that moves under a load) rises, is held and is released. The strain grows, and a
// part of it recovers.
TEST_F(SteppedSpectrum, IsTheCreepAndTheRecovery) {
  const double stress = 1e5, rise = 0.02, release = 0.1, end = 0.3, mass = 1e-4;
  StepperOptions given = options(100, 200);
  // the critical step depends on the platen's mass
  given.boundary.load(wall_z_hi, 2, std::make_shared<drives::Ramp>(), mass);
  given.dt = rise / std::ceil(rise / step(given));
  const auto rise_steps = std::llround(rise / given.dt), held = std::llround(release / given.dt) - rise_steps;
  given.boundary.load(wall_z_hi, 2, std::make_shared<drives::Ramp>(stress * area_, given.dt, rise_steps, held), mass);
  const auto stepper = make(given);
  const double held_until = static_cast<double>(rise_steps + held) * given.dt;
  double largest = 0, last = 0;
  sample(*stepper, std::llround(end / 60 / given.dt), 60, [&](const Observation& now) {
    const double expected =
        stress * (spectrum_.creep.after_ramp(now.time, rise) -
                  (now.time > held_until ? spectrum_.creep.after_ramp(now.time - held_until, rise) : 0));
    last = now.top_displacement() / height_;
    largest = std::max(largest, expected);
    // A ramp of 20 ms causes waves of about 0.3 ms. They decay within twice the length of the ramp.
    const bool rings = now.time < 3 * rise || (now.time > held_until && now.time < held_until + 3 * rise);
    EXPECT_NEAR(last, expected, (rings ? 1e-2 : 1e-4) * largest) << now.time << " s";
  });
  EXPECT_GT(last, 0.2 * largest) << "viscous strain remains";
  EXPECT_LT(last, 0.9 * largest) << "elastic strain returns";
}

}  // namespace
}  // namespace macadam::test
