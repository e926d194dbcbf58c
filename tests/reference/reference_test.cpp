// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_test.cpp  Compares the reference stepper with solutions worked out on paper.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "macadam/error.hpp"
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
using test::same_law;
using test::spring;

/// B makes a small displacement in one direction or a small rotation about one axis, while A rests. The pair has an
/// oblique normal and a facet whose centroid is off the line of centres.
class SmallMotion : public testing::TestWithParam<Geometry> {
 protected:
  static constexpr double amount = 1e-9;  // displacement [m], or rotation in radians per 1 mm of lever arm

  SmallMotion() {
    shape.s0 = 1.0e-4;
    shape.t0 = -2.0e-4;
    made = test::two_sphere_network(shape);
    contact = made.network.contacts[0];
  }
  ParticleState after(const Vec3d& displacement, const Vec3d& rotation) {
    const double dt = 1e-3;
    auto stepper = make(made, spring, options_of(dt / 10, GetParam()));
    stepper->set_velocities({{}, (1 / dt) * displacement}, {{}, (1 / dt) * rotation});
    stepper->advance(10);
    return stepper->particles();
  }
  /// Expects the given forces and moments on A and B. In updated geometry the normal rotates by amount/distance = 6e-7,
  /// so the tolerance is 2e-6.
  void expect_loads(const ParticleState& p, const Vec3d& force_a, const Vec3d& moment_a, const Vec3d& moment_b) {
    const double error = GetParam() == Geometry::fixed ? 1e-13 : 2e-6;
    const double force = E * contact.area / contact.distance * amount;
    expect_near(p.force[0], force_a, error * force, "force on A");
    expect_near(p.force[1], -force_a, error * force, "force on B");
    expect_near(p.moment[0], moment_a, error * force * contact.distance, "moment on A");
    expect_near(p.moment[1], moment_b, error * force * contact.distance, "moment on B");
  }

  PairShape shape = heavy({2.0 / 7, 3.0 / 7, 6.0 / 7});
  HandMade made;
  Contact contact;
};
INSTANTIATE_TEST_SUITE_P(Geometries, SmallMotion, testing::Values(Geometry::fixed, Geometry::updated),
                         [](const auto& info) { return info.param == Geometry::fixed ? "Fixed" : "Updated"; });

// First moments of the points are A·s0 and A·t0. The frame satisfies n × ŝ = t̂, n × t̂ = −ŝ, ŝ × t̂ = n.
TEST_P(SmallMotion, Opening) {
  const Vec3d &n = contact.n, &s = contact.s, &t = contact.t;
  const double f = E * contact.area / contact.distance * amount;
  const Vec3d moment = f * (shape.t0 * s - shape.s0 * t);  // (s0·ŝ + t0·t̂) × f·n
  expect_loads(after(amount * n, {}), f * n, moment, -moment);
}

TEST_P(SmallMotion, Slip) {
  const Vec3d &n = contact.n, &s = contact.s, &t = contact.t;
  const double f = alpha * E * contact.area / contact.distance * amount;
  const Vec3d twist = -(f * shape.t0) * n;  // t0·t̂ × f·ŝ
  expect_loads(after(amount * s, {}), f * s, f * contact.arm_a * t + twist, f * contact.arm_b * t - twist);
}

// B rotates by θ about ŝ. The point (s, t) opens by θ·t and, since it is arm_b below B, slips by θ·arm_b along t̂.
TEST_P(SmallMotion, Bending) {
  const Vec3d &n = contact.n, &s = contact.s, &t = contact.t;
  const double theta = amount / 1e-3, k = E / contact.distance * theta;
  const AreaMoments& m = contact.moments;
  const double slip = alpha * k * m.a * contact.arm_b;
  // sum of moments Σ (s·ŝ + t·t̂) × (k·t·n + α·k·arm_b·t̂)·A_J
  const Vec3d about_x0 = k * (m.tt * s - m.st * t) + alpha * k * contact.arm_b * m.s * n;
  expect_loads(after({}, theta * s), k * m.t * n + slip * t, about_x0 - contact.arm_a * slip * s,
               -about_x0 - contact.arm_b * slip * s);
}

// B rotates by θ about n. The point (s, t) slips by θ·(s·t̂ − t·ŝ).
TEST_P(SmallMotion, Twist) {
  const Vec3d &n = contact.n, &s = contact.s, &t = contact.t;
  const double theta = amount / 1e-3, k = alpha * E / contact.distance * theta;
  const AreaMoments& m = contact.moments;
  const double along_s = -k * m.t, along_t = k * m.s;
  const Vec3d about_x0 = k * (m.ss + m.tt) * n;
  const Vec3d lever = along_s * t - along_t * s;  // n × force
  expect_loads(after({}, theta * n), along_s * s + along_t * t, about_x0 + contact.arm_a * lever,
               -about_x0 + contact.arm_b * lever);
}

// A pair whose spheres move at constant velocity prescribes the displacement of the contact, so the force must follow
// the law of AM1.
TEST(Reference, ContactFollowsItsLaw) {
  HandMade made = test::two_sphere_network(heavy());
  const auto law = test::mastic_am1();
  const double dt = 1e-3;
  auto stepper = make(made, law, options_of(dt, Geometry::fixed));
  stepper->set_velocities({{}, {1e-6, 0, 1e-6}}, {{}, {}});
  const auto step = law.step<double>(dt);
  double f = 0, x[3] = {};
  for (int k = 0; k < 500; ++k) f = step.advance<3>(f, 1e-6 * dt, [&](int l) -> double& { return x[l]; });
  stepper->advance(500);
  const Contact& c = made.network.contacts[0];
  const double scale = c.area / c.distance, tolerance = 1e-12 * scale * f;  // rounding of 500 steps
  EXPECT_NEAR(stepper->particles().force[0].z, scale * f, tolerance);
  EXPECT_NEAR(stepper->particles().force[0].x, law.alpha * scale * f, tolerance);
}

// Viscosities of dashpots in series add as their inverses, so a Kelvin unit without a spring acts like a softer Maxwell
// dashpot.
TEST(Reference, AUnitWithoutASpringIsADashpot) {
  const HandMade made = test::two_sphere_network(heavy());
  const auto force_under = [&](const laws::GeneralisedKelvin& law) {
    auto stepper = make(made, law, options_of(1e-3, Geometry::fixed));
    stepper->set_velocities({{}, {0, 0, 1e-6}}, {{}, {}});
    stepper->advance(500);
    return stepper->particles().force[0].z;
  };
  const laws::GeneralisedKelvin of_a_unit{1e10, 3e9, {0}, {6e9}, 0.1}, alone{1e10, 2e9, {}, {}, 0.1};
  EXPECT_NEAR(force_under(of_a_unit) / force_under(alone), 1, 1e-11);
  EXPECT_THROW(force_under({1e10, 3e9, {-1}, {6e9}, 0.1}), InputError);
}

TEST(Reference, BondsWithoutStrengthAreRefused) {
  const HandMade made = test::two_sphere_network();
  const auto made_of = [&](const laws::BrittleBond& bond) { make(made, bond, options_of(1e-6, Geometry::fixed)); };
  EXPECT_NO_THROW(made_of({1e9, 1e5, 1e5, 0.1}));
  EXPECT_THROW(made_of({0, 1e5, 1e5, 0.1}), InputError);
  EXPECT_THROW(made_of({1e9, 0, 1e5, 0.1}), InputError);
  EXPECT_THROW(made_of({1e9, 1e5, 0, 0.1}), InputError);
}

TEST(Reference, ViscousDampingDecaysAsItsClosedForm) {
  const HandMade made = test::two_sphere_network();
  StepperOptions options = options_of(1e-4, Geometry::fixed);
  options.damping_kind = Damping::viscous;
  options.damping = 25;
  options.density_scaling = 7;  // without forces the mass does not matter
  auto stepper = make(made, spring, options);
  const Vec3d v{0.01, -0.02, 0.03};
  stepper->set_velocities({v, v}, {{}, {}});
  stepper->advance(1000);
  const double b = 25 * 1e-4 / 2, discrete = std::pow((1 - b) / (1 + b), 1000);
  expect_near(stepper->particles().velocity[1], discrete * v, 1e-13 * norm(v), "velocity");  // 1000 roundings
  EXPECT_NEAR(discrete / std::exp(-25 * 0.1), 1, 2e-6);                                      // β³Δt²·T/12 = 1.3e-6
}

// After one step the force on A is known, k·Δt·v along z. Local damping adds χ times the size of this force, against
// the motion.
TEST(Reference, LocalDampingOpposesEveryComponent) {
  const HandMade made = test::two_sphere_network();
  const Contact& c = made.network.contacts[0];
  StepperOptions options = options_of(1e-8, Geometry::fixed);
  options.damping_kind = Damping::local;
  options.damping = 0.2;
  options.density_scaling = 10;
  auto stepper = make(made, spring, options);
  stepper->set_velocities({{0, 0, -0.01}, {0, 0, 0.02}}, {{}, {}});
  stepper->advance(2);
  const double force = E * c.area / c.distance * 1e-8 * 0.03;
  const ParticleState p = stepper->particles();
  // A is pulled up (+) while it moves down (−), so damping also acts upwards. On B, pull and damping act downwards.
  EXPECT_NEAR(p.velocity[0].z, -0.01 + 1e-8 * 1.2 * force / (10 * 2e-5), 1e-15);
  EXPECT_NEAR(p.velocity[1].z, 0.02 - 1e-8 * 1.2 * force / (10 * 1e-5), 1e-15);
}

// A fixed sphere lies between two walls. The spring of the top wall has d = h; the bottom wall stays at rest.
TEST(Reference, TheTopWallFollowsItsLoading) {
  const double side = 2e-3;
  const HandMade made = test::cubic_lattice_network(1, 1, 1, side, 1e-5);
  const drives::Cyclic loading{1e-7, 2.0, 1000, 250};
  for (Geometry geometry : {Geometry::fixed, Geometry::updated}) {
    StepperOptions options = options_of(loading.dt(), geometry);
    options.boundary = moving_top(loading);
    options.boundary.fixed = {0};
    auto stepper = make(made, spring, options);
    stepper->advance(700);
    const Observation seen = stepper->observe();
    EXPECT_EQ(seen.step, 700);
    EXPECT_DOUBLE_EQ(seen.time, 0.35);
    // During the smooth start the velocity is exact to (2π/1000)² = 4e-5. The relative error of the displacement is the
    // mean of this error.
    EXPECT_NEAR(seen.top_displacement(), loading.value(700), 1e-5 * loading.amplitude);
    const double stiffness = E * side * side / (side / 2);
    expect_near(seen.wall_force[wall_index(wall_z_hi)], {0, 0, -stiffness * seen.top_displacement()},
                1e-12 * stiffness * 1e-7, "top");
    expect_near(seen.wall_force[wall_index(wall_z_lo)], {0, 0, 0}, 1e-12 * stiffness * 1e-7, "bottom");
  }
}

// By Eq. 5 of [1], each lever arm grows by half of the opening when the centres move apart.
TEST(Reference, LeverArmsShareTheOpening) {
  const HandMade made = test::two_sphere_network(heavy());
  const Contact& c = made.network.contacts[0];
  const double open = 1e-4, slide = 1e-7;
  auto stepper = make(made, spring, options_of(1.0, Geometry::updated));
  stepper->set_velocities({{}, {0, 0, open}}, {{}, {}});
  stepper->advance(1);
  stepper->set_velocities({{}, {slide, 0, 0}}, {{}, {}});
  stepper->advance(1);
  const ParticleState p = stepper->particles();
  const double shear = alpha * E * c.area / c.distance * slide;  // with the initial distance d, which does not change
  // The normal rotates by slide/d = 6e-5, whose square is 3e-9. The normal force has no moment about this axis.
  EXPECT_NEAR(p.moment[0].y / (shear * (c.arm_a + open / 2)), 1, 1e-8);
  EXPECT_NEAR(p.moment[1].y / (shear * (c.arm_b + open / 2)), 1, 1e-8);
}

// The lever arm of a wall contact ends on the plane of the wall, so it shortens as the particle rises towards the wall.
TEST(Reference, WallLeverFollowsTheParticle) {
  const double side = 2e-3;
  const HandMade made = test::cubic_lattice_network(1, 1, 1, side, 1e30);
  const double rise = 1e-4, slide = 1e-6;
  auto stepper = make(made, spring, options_of(1.0, Geometry::updated));
  stepper->set_velocities({{0, 0, rise}}, {{}});
  stepper->advance(1);
  stepper->set_velocities({{slide, 0, 0}}, {{}});
  stepper->advance(1);
  const ParticleState p = stepper->particles();
  const double shear = alpha * E * side * side / (side / 2) * slide;
  EXPECT_NEAR(p.force[0].x, -2 * shear, 1e-12 * shear);
  // Moments: (h − rise)·ẑ × −shear·x̂ at the top and −(h + rise)·ẑ × −shear·x̂ at the bottom. The normal forces act on
  // the axis, so they give no moment except for rounding. Each is rise/slide/α = 333 times the shear force; the
  // tolerance allows for the rounding of its moment with a lever arm of h.
  EXPECT_NEAR(p.moment[0].y, 2 * rise * shear, 1e-12 * shear * side);
}

TEST(Reference, ReportsTheFirstDivergentParticle) {
  const HandMade made = test::two_sphere_network(heavy());
  auto stepper = make(made, spring, options_of(1e-3, Geometry::updated));
  EXPECT_EQ(stepper->first_divergent(), -1);
  stepper->set_velocities({{0.9, 0, 0}, {0.9, 0, 0}}, {{}, {}});  // 0.9 mm per step, more than B's radius of 0.8 mm
  EXPECT_EQ(stepper->first_divergent(), 1);
  stepper->set_velocities({{}, {}}, {{}, {0, NAN, 0}});
  EXPECT_EQ(stepper->first_divergent(), 1) << "a spin alone";
  stepper->set_velocities({{NAN, 0, 0}, {}}, {{}, {}});
  EXPECT_EQ(stepper->first_divergent(), 0) << "a velocity alone";
  stepper->advance(1);
  stepper->set_velocities({{}, {}}, {{}, {}});
  EXPECT_EQ(stepper->first_divergent(), 0) << "a displacement alone";
}

TEST(Reference, RefusesWhatItCannotStep) {
  const HandMade good = test::two_sphere_network();
  const auto message = [&](auto&& spoil) -> std::string {
    HandMade made = good;
    test::Laws laws = same_law(spring);
    StepperOptions options = options_of(1e-7, Geometry::updated);
    spoil(made, laws, options);
    try {
      make_reference_stepper(made.specimen, made.network, laws, made.inertia, options);
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  };
  const auto expect = [&](const char* part, auto&& spoil) {
    EXPECT_NE(message(spoil).find(part), std::string::npos) << message(spoil);
  };
  expect("accepted", [](HandMade&, test::Laws&, StepperOptions&) {});
  expect("mixed", [](HandMade&, test::Laws&, StepperOptions& o) { o.precision = Precision::mixed; });
  expect("time step", [](HandMade&, test::Laws&, StepperOptions& o) { o.dt = 0; });
  expect("damping", [](HandMade&, test::Laws&, StepperOptions& o) { o.damping = -1; });
  expect("density scaling", [](HandMade&, test::Laws&, StepperOptions& o) { o.density_scaling = NAN; });
  expect("M-M", [](HandMade&, test::Laws& l, StepperOptions&) { l[0].reset(); });
  expect("particle 1", [](HandMade& m, test::Laws&, StepperOptions&) { m.inertia.mass[1] = 0; });
  expect("masses", [](HandMade& m, test::Laws&, StepperOptions&) { m.inertia.mass.pop_back(); });
  expect("contact 0 (2 – 1)", [](HandMade& m, test::Laws&, StepperOptions&) { m.network.contacts[0].a = 2; });
  expect("contact 0 (0 – 2)", [](HandMade& m, test::Laws&, StepperOptions&) { m.network.contacts[0].b = 2; });
  expect("contact 0 (0 – 7)", [](HandMade& m, test::Laws&, StepperOptions&) { m.network.contacts[0].b = 7; });
  expect("distance", [](HandMade& m, test::Laws&, StepperOptions&) { m.network.contacts[0].distance = 0; });
  expect("contact points", [](HandMade& m, test::Laws&, StepperOptions&) { m.network.point_s.pop_back(); });
  auto stepper = make(good, spring, options_of(1e-7, Geometry::fixed));
  EXPECT_THROW(stepper->set_velocities({{}}, {{}, {}}), InputError);
}

}  // namespace
}  // namespace macadam
