// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_conservation_test.cpp  Tests conservation laws of the reference stepper: contact loads rotate with
/// the pair of particles, and momenta and energy are conserved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "tests/reference/reference_pair.hpp"

namespace macadam {
namespace {

using test::alpha;
using test::E;
using test::expect_near;
using test::HandMade;
using test::heavy;
using test::make;
using test::options_of;
using test::PairShape;
using test::spring;

// A pair is opened, sheared, bent and twisted. Then it is rotated rigidly by 2 rad about an oblique axis, and the loads
// must rotate with it. The stepper evaluates velocities in the contact frame at the middle of the step. In this frame
// the chord of B's path around A is tangential.
TEST(Reference, RigidRotationCreatesNoForce) {
  const HandMade made = test::two_sphere_network(heavy({2.0 / 7, 3.0 / 7, 6.0 / 7}));
  const Contact& c = made.network.contacts[0];
  const double dt = 1e-3;
  const int steps = 40'000;
  auto stepper = make(made, spring, options_of(dt, Geometry::updated));
  const Vec3d stretch{2e-6, 1e-6, 3e-6};
  stepper->set_velocities({{}, (1 / dt) * stretch}, {{}, {2.0, -1.0, 3.0}});
  stepper->advance(1);
  const ParticleState before = stepper->particles();

  const double root = std::sqrt(14.0), step_angle = 2.0 / steps;
  const Vec3d axis{1 / root, 2 / root, 3 / root};
  const auto turned = [&](const Vec3d& v, double angle) {  // Rodrigues' formula
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + (1 - std::cos(angle)) * dot(axis, v) * axis;
  };
  const Vec3d centres = c.distance * c.n + stretch;
  const Vec3d spin = (step_angle / dt) * axis;
  for (int k = 0; k < steps; ++k) {
    const Vec3d move = turned(centres, (k + 1) * step_angle) - turned(centres, k * step_angle);
    stepper->set_velocities({{}, (1 / dt) * move}, {spin, spin});
    stepper->advance(1);
  }
  // One error remains. In each step B rotates by ω·Δt but moves along the chord, which is (5e-5)³/24·d shorter than the
  // arc. After 40,000 steps this is 2e-10·d, a slip of 4e-13 m compared with a stretch of 4e-6 m. Rounding of n·d adds
  // about 40,000·ε·d = 1e-14 m.
  const double tolerance = 1e-7 * norm(before.force[0]);
  const ParticleState after = stepper->particles();
  expect_near(after.force[0], turned(before.force[0], 2.0), tolerance, "force on A");
  expect_near(after.moment[0], turned(before.moment[0], 2.0), tolerance * c.distance, "moment on A");
  expect_near(after.moment[1], turned(before.moment[1], 2.0), tolerance * c.distance, "moment on B");
}

struct Momenta {
  Vec3d linear, angular;
};

/// Returns the total momenta. If `displaced`, angular momentum uses the displaced centres, as updated geometry does.
Momenta momenta(const HandMade& made, const ParticleState& p, bool displaced) {
  Momenta out;
  for (std::size_t i = 0; i < made.specimen.size(); ++i) {
    const double m = made.inertia.mass[i], inertia = made.inertia.inertia[i];
    const Vec3d x = displaced ? made.specimen.centre[i] + p.displacement[i] : made.specimen.centre[i];
    out.linear += m * p.velocity[i];
    out.angular += m * cross(x, p.velocity[i]) + inertia * p.spin[i];
  }
  return out;
}

class FreePair : public testing::TestWithParam<std::tuple<Geometry, int>> {};
INSTANTIATE_TEST_SUITE_P(GeometriesAndLaws, FreePair,
                         testing::Combine(testing::Values(Geometry::fixed, Geometry::updated), testing::Values(0, 1)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) == Geometry::fixed ? "Fixed" : "Updated") +
                                  (std::get<1>(info.param) == 0 ? "Elastic" : "Kelvin");
                         });

TEST_P(FreePair, MomentaStay) {
  PairShape shape;
  shape.n = {2.0 / 7, -6.0 / 7, 3.0 / 7};
  shape.s0 = 1e-4;
  const HandMade made = test::two_sphere_network(shape);
  const auto [geometry, kind] = GetParam();
  const Law law = kind == 0 ? Law(spring) : Law(test::mastic_am2());
  const double dt = kind == 0 ? 2e-7 : 6e-8;  // ωΔt < 0.1 in every mode of the pair
  auto stepper = make(made, law, options_of(dt, geometry));
  stepper->set_velocities({{0.1, -0.2, 0.3}, {-0.2, 0.3, 0.1}}, {{50, -20, 30}, {-10, 40, 60}});
  const bool displaced = geometry == Geometry::updated;
  const Momenta start = momenta(made, stepper->particles(), displaced);
  const int steps = 10'000;
  stepper->advance(steps);
  const ParticleState p = stepper->particles();
  const Momenta end = momenta(made, p, displaced);
  ASSERT_EQ(stepper->first_divergent(), -1);
  // The forces of a pair are of the order m·v·ω and are rounded in every step. Over 1e4 steps this is a random walk of
  // 100·1e-16, relative to momenta of 1e-5 kg·0.4 m/s with lever arms of 5e-3 m. Ten times this error is allowed.
  const double scale = 1e-5 * 0.4;
  expect_near(end.linear, start.linear, 1e-13 * scale, "momentum");
  expect_near(end.angular, start.angular, 1e-13 * scale * 5e-3, "angular momentum");
  EXPECT_GT(norm(p.force[0]), 0);
}

// With a single mode, opening, leapfrog conserves ½·μ·v(k−½)·v(k+½) + ½·k·x(k)² exactly. Here μ is the reduced mass of
// the pair, and x(k) is the force over the stiffness.
TEST(Reference, EnergyOfAnElasticPairStays) {
  const HandMade made = test::two_sphere_network();
  const Contact& c = made.network.contacts[0];
  const double stiffness = E * c.area / c.distance, mass = 1 / (1 / 2.0e-5 + 1 / 1.0e-5);
  const double dt = 0.3 / std::sqrt(stiffness / mass);
  auto stepper = make(made, spring, options_of(dt, Geometry::fixed));
  stepper->set_velocities({{}, {0, 0, 0.1}}, {{}, {}});
  const auto opening_rate = [](const ParticleState& p) { return p.velocity[1].z - p.velocity[0].z; };
  const double energy = 0.5 * mass * 0.1 * 0.1;
  stepper->advance(1);
  ParticleState now = stepper->particles();
  for (int k = 0; k < 10'000; ++k) {
    stepper->advance(1);
    const ParticleState next = stepper->particles();
    const double x = now.force[0].z / stiffness;
    const double kept = 0.5 * mass * opening_rate(now) * opening_rate(next) + 0.5 * stiffness * x * x;
    ASSERT_NEAR(kept / energy, 1, 1e-12) << k;  // random walk of 1e4 steps with a few 1e-16 each
    now = next;
  }
}

// With all modes and updated geometry, kinetic energy returns to its initial value and does not exceed it.
TEST(Reference, EnergyOfAnElasticPairIsBoundedInUpdatedGeometry) {
  PairShape shape;
  shape.s0 = 2e-4;
  const HandMade made = test::two_sphere_network(shape);
  auto stepper = make(made, spring, options_of(2e-7, Geometry::updated));
  stepper->set_velocities({{0.01, 0.02, -0.01}, {-0.02, -0.04, 0.02}}, {{5, -2, 3}, {-1, 4, 6}});
  const auto kinetic = [&] {
    const ParticleState p = stepper->particles();
    double sum = 0;
    for (int i = 0; i < 2; ++i) {
      sum += 0.5 * made.inertia.mass[i] * dot(p.velocity[i], p.velocity[i]);
      sum += 0.5 * made.inertia.inertia[i] * dot(p.spin[i], p.spin[i]);
    }
    return sum;
  };
  const double start = kinetic();
  double early = 0, late = 0;
  for (int k = 0; k < 20'000; ++k) {
    stepper->advance(1);
    (k < 10'000 ? early : late) = std::max(k < 10'000 ? early : late, kinetic());
  }
  // Half-step velocities exceed the bound by (ωΔt)²/4 < 0.0025. Between the maxima the springs hold a part of the
  // energy.
  EXPECT_LT(early, 1.0025 * start);
  EXPECT_LT(late, 1.0025 * start);
  EXPECT_GT(late, 0.5 * start);
}

}  // namespace
}  // namespace macadam
