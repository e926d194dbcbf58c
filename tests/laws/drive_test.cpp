// SPDX-License-Identifier: GPL-3.0-or-later
// drive_test.cpp  Compares drives (prescribed motions and loads as functions of time) with their formulas. Tests driven
// walls, platens (walls that move under a load), fixed particles and body forces on every backend: against the
// reference stepper, conservation of momentum and static solutions.
#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

#include "kernels/step/block_length.hpp"
#include "kernels/step/wall_motion.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_networks.hpp"

namespace macadam::test {
namespace {

/// Expects that the rates over all steps add up to the change of the drive's value, and that fastest() is the largest
/// rate.
void expect_rates_of(const Drive& drive, std::int64_t steps, double scale) {
  double sum = drive.value(0), fastest = 0;
  for (std::int64_t k = 0; k < steps; ++k) {
    sum += drive.dt() * drive.rate(k);
    fastest = std::max(fastest, std::abs(drive.rate(k)));
    ASSERT_NEAR(sum, drive.value(k + 1), 1e-12 * scale) << k;
  }
  EXPECT_LE(fastest, drive.fastest() * (1 + 1e-9));
  EXPECT_GE(fastest, 0.9 * drive.fastest());
}

TEST(Drives, RampRisesHoldsAndFalls) {
  const double dt = 1e-3;
  for (const bool smooth : {false, true}) {
    const drives::Ramp ramp(2e-6, dt, 40, 100, smooth);
    expect_rates_of(ramp, 200, 2e-6);
    EXPECT_EQ(ramp.value(-1), 0);
    EXPECT_EQ(ramp.value(0), 0);
    EXPECT_NEAR(ramp.value(20), 1e-6, 1e-18);
    EXPECT_EQ(ramp.value(40), 2e-6);
    EXPECT_EQ(ramp.value(140), 2e-6);
    EXPECT_NEAR(ramp.value(160), 1e-6, 1e-18);
    EXPECT_NEAR(ramp.value(180), 0, 1e-18);
    EXPECT_NEAR(ramp.value(10'000), 0, 1e-18);
  }
  EXPECT_EQ(drives::Ramp(3, dt).value(1), 3) << "a jump within one step";
  EXPECT_EQ(drives::Ramp(3, dt).value(std::int64_t{1} << 60), 3) << "held for ever";
}

TEST(Drives, ConstantRateAndTable) {
  const drives::ConstantRate even(-1e-3, 1e-4, 1);
  expect_rates_of(even, 1000, 1e-4);
  EXPECT_DOUBLE_EQ(even.value(500), -5e-5);
  const drives::Table table(0.25, {1, 2, 4}, {5, 7, 3});
  expect_rates_of(table, 30, 7);
  EXPECT_EQ(table.value(0), 5);
  EXPECT_EQ(table.value(6), 6);   // at 1.5 s
  EXPECT_EQ(table.value(12), 5);  // at 3 s
  EXPECT_EQ(table.value(100), 3);
  EXPECT_EQ(table.shortest_time(), 1);
  EXPECT_EQ(table.fastest(), 2);
  EXPECT_THROW(drives::Table(0.25, {1, 1}, {5, 7}), InputError);
  EXPECT_THROW(drives::Table(0.25, {1, 2}, {5, NAN}), InputError);
  EXPECT_THROW(drives::Table(0.25, {1}, {5}), InputError);
  EXPECT_THROW(drives::Table(0.25, {1, 2, 3}, {5, 6}), InputError);
}

TEST(Drives, HaversinePulsesWithRest) {
  const double dt = 1e-3, height = -2e-6;
  const drives::Haversine load(height, dt, 40, 160, 3);
  expect_rates_of(load, 700, std::abs(height));
  for (const int pulse : {0, 1, 2}) {
    const std::int64_t begin = 200 * pulse;
    EXPECT_EQ(load.value(begin), 0);
    EXPECT_NEAR(load.value(begin + 10), height / 2, 1e-12 * std::abs(height));  // ½·(1 − cos 90°)
    EXPECT_EQ(load.value(begin + 20), height);
    EXPECT_NEAR(load.value(begin + 33), height / 2 * (1 - std::cos(2 * std::numbers::pi * 33 / 40)), 1e-18);
    for (const int resting : {40, 41, 120, 199}) EXPECT_EQ(load.value(begin + resting), 0) << resting;
    EXPECT_EQ(load.rate(begin + 40), 0);
    EXPECT_EQ(load.value(begin + 20), load.value(20)) << "the last pulse is the first, to the bit";
  }
  for (const std::int64_t outside : {std::int64_t{-1}, std::int64_t{-20}, std::int64_t{620}, std::int64_t{1} << 60})
    EXPECT_EQ(load.value(outside), 0) << outside;
  EXPECT_EQ(drives::Haversine(3, dt, 40, 0).value(20 + 40 * (std::int64_t{1} << 50)), 3) << "for ever, without rest";
  EXPECT_DOUBLE_EQ(load.shortest_time(), 0.04);
}

class DrivenWalls : public BackendTest<StepperCase> {
 protected:
  /// Compares motion of particles and walls, and forces on walls, with the reference stepper.
  void compare(const TestScene& scene, StepperOptions options, std::int64_t steps) {
    const auto& [backend, precision, form, geometry] = GetParam();
    options.form = form;
    options.geometry = geometry;
    const auto reference =
        make_stepper(Backend::reference, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    options.precision = precision;
    const auto stepper = make_stepper(backend, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    const bool blocks = backend == Backend::cuda && precision != Precision::double_ && form == ContactForm::condensed &&
                        kernels::block_steps(options, facts_of(scene.laws), scene.specimen.box.size) > 0;
    EXPECT_EQ(stepper->description().find("tiles") != std::string::npos, blocks) << stepper->description();
    for (const Vec3d& v : stepper->observe().wall_velocity) EXPECT_EQ(norm(v), 0);
    reference->advance(steps);
    stepper->advance(steps / 3);
    stepper->advance(steps - steps / 3);
    // This is the tolerance that StepperAgainstReference::tolerance() returns.
    const double rounding = precision == Precision::double_ ? 100 * 0x1p-53 : 10 * 0x1p-24;
    const double tolerance = rounding * static_cast<double>(std::max<std::int64_t>(steps, 100));
    const ParticleState expected = reference->particles(), found = stepper->particles();
    EXPECT_LT(relative_difference(found.displacement, expected.displacement), tolerance);
    // Rotations are differences of slips. Under a drive tangential to the facets they are small, so their relative
    // error is larger.
    EXPECT_LT(relative_difference(found.rotation, expected.rotation), 10 * tolerance);
    EXPECT_LT(relative_difference(found.velocity, expected.velocity), tolerance);
    EXPECT_LT(relative_difference(found.force, expected.force), tolerance);
    const Observation want = reference->observe(), have = stepper->observe();
    const auto list = [](const auto& array) { return std::vector<Vec3d>(array.begin(), array.end()); };
    EXPECT_LT(relative_difference(list(have.wall_force), list(want.wall_force)), tolerance);
    EXPECT_LT(relative_difference(list(have.wall_velocity), list(want.wall_velocity)), tolerance);
    // The rates of a cyclic drive add up to its value with an error of second order in the step.
    EXPECT_LT(relative_difference(list(have.wall_displacement), list(want.wall_displacement)), 1e-4);
  }
  static TestScene scene(unsigned seed) {
    NetworkSpec spec;
    spec.lateral_walls = true;
    return make_scene(random_specimen(seed), spec);
  }
};

TEST_P(DrivenWalls, OnSeveralAxesAtOnce) {
  const TestScene of = scene(test_seed());
  StepperOptions options = slow_options(of);
  const double size = of.specimen.box.size.z;
  drives::Cyclic shear = top_drive(options);
  shear.amplitude *= 0.3;
  options.boundary.move(wall_z_hi, 0, std::make_shared<drives::Cyclic>(shear));
  options.boundary.move(wall_x_lo, 0, std::make_shared<drives::Ramp>(2e-5 * size, options.dt, 60, 30, true));
  options.boundary.move(wall_y_hi, 1, std::make_shared<drives::ConstantRate>(-1e-2 * size, options.dt, 1.0));
  compare(of, options, 150);
}

// If the walls move slowly, a device (GPU) updates the viscoelastic state only once per block of several steps. This
// test moves several walls in that way.
TEST_P(DrivenWalls, SlowlyOnSeveralWalls) {
  const TestScene of = scene(test_seed() + 3);
  StepperOptions options = slow_options(of);
  drives::Cyclic side = top_drive(options);
  side.amplitude *= -0.4;
  options.boundary.move(wall_x_lo, 0, std::make_shared<drives::Cyclic>(side));
  options.boundary.move(wall_x_hi, 1, std::make_shared<drives::Cyclic>(side));
  options.boundary.move(wall_y_lo, 1,
                        std::make_shared<drives::ConstantRate>(1e-3 * of.specimen.box.size.y, options.dt, 1.0));
  compare(of, options, 300);
}

TEST_P(DrivenWalls, UnderForcesWithFixedParticlesAndWeight) {
  const TestScene of = scene(test_seed() + 1);
  StepperOptions options = shaking_options(of);
  double mass = 0;
  for (const double m : of.inertia.mass) mass += m;
  options.density_scaling = 2;
  const double area = of.specimen.box.size.x * of.specimen.box.size.y;
  options.boundary.load(wall_z_hi, 2, std::make_shared<drives::Ramp>(-1e5 * area, options.dt, 50), mass);
  options.boundary.load(
      wall_z_hi, 0, std::make_shared<drives::Table>(options.dt, std::vector{0.0, 1e-3}, std::vector{0.0, 3e4 * area}),
      mass);
  options.boundary.fixed = {3, 17};
  for (const double m : of.inertia.mass) options.boundary.body_force.push_back({0, 100 * m, -981 * m});
  compare(of, options, 150);
}

// Laboratories usually apply pulses with rests between them. The motion is so slow that a step rotates normals by at
// most about 5e-7 rad. The stepper and the reference stepper differ by the square of this angle.
TEST_P(DrivenWalls, UnderHaversinePulses) {
  const TestScene of = scene(test_seed() + 4);
  StepperOptions options = shaking_options(of);
  options.boundary = {};
  double mass = 0;
  for (const double m : of.inertia.mass) mass += m;
  const double area = of.specimen.box.size.x * of.specimen.box.size.y, size = of.specimen.box.size.x;
  options.boundary.load(wall_z_hi, 2, std::make_shared<drives::Haversine>(-1e5 * area, options.dt, 60, 30), mass);
  options.boundary.move(wall_x_lo, 0, std::make_shared<drives::Haversine>(5e-6 * size, options.dt, 80, 20, 1));
  // the run ends within the second pulse of the platen, and after the only pulse of the side wall
  compare(of, options, 120);
}

// The wall has more contacts than a single thread on a device (GPU) sums up.
TEST_P(DrivenWalls, APlatenOnManyParticles) {
  const TestScene of = make_scene(random_specimen(test_seed() + 5, 9, 9, 2));
  std::int64_t on_top = 0;
  for (const Contact& c : of.network.contacts) on_top += c.b == wall_z_hi;
  ASSERT_GT(on_top, 64);
  StepperOptions options = shaking_options(of);
  options.boundary = {};
  const double area = of.specimen.box.size.x * of.specimen.box.size.y;
  options.boundary.load(wall_z_hi, 2, std::make_shared<drives::Ramp>(-1e5 * area, options.dt, 50), 1e-3);
  compare(of, options, 100);
}

// A stepper tabulates the motion of the walls for a limited number of steps at once; this run has more steps.
TEST_P(DrivenWalls, OverMoreStepsThanOnePieceOfTheTable) {
  const std::int64_t piece = kernels::WallTable<double>::most_rows;
  const TestScene of = make_scene(random_specimen(test_seed() + 6, 2, 2, 2));
  StepperOptions options = shaking_options(of);
  options.damping_kind = Damping::viscous;
  options.damping = 1e4;
  options.boundary = {};
  const double size = of.specimen.box.size.z, area = of.specimen.box.size.x * of.specimen.box.size.y;
  // In the second piece of the table each wall moves or is loaded differently than in the first.
  const auto steps = [&](std::int64_t k) { return static_cast<double>(k) * options.dt; };
  options.boundary.move(wall_z_lo, 2,
                        std::make_shared<drives::Table>(options.dt, std::vector{0.0, steps(piece), steps(2 * piece)},
                                                        std::vector{0.0, 1e-5 * size, -2e-5 * size}));
  options.boundary.load(wall_z_hi, 2,
                        std::make_shared<drives::Table>(options.dt, std::vector{0.0, steps(piece), steps(2 * piece)},
                                                        std::vector{0.0, 1e5 * area, -2e5 * area}),
                        1e-4);
  compare(of, options, piece + 300);
}

// If the wall moves slowly, a device (GPU) updates the viscoelastic state only once per block of several steps. This
// test has fixed particles and weight in such a run.
TEST_P(DrivenWalls, FixedParticlesAndWeightUnderASlowDrive) {
  const TestScene of = scene(test_seed() + 2);
  StepperOptions options = slow_options(of);
  options.boundary.fixed = {5};
  for (const double m : of.inertia.mass) options.boundary.body_force.push_back({0, 0, -9810 * m});
  compare(of, options, 300);
}

INSTANTIATE_TEST_SUITE_P(All, DrivenWalls, all_stepper_cases(), [](const auto& info) { return name_of_case(info); });

class Platen : public BackendTest<std::tuple<Backend, Precision>> {
 protected:
  std::unique_ptr<Stepper> make(const TestScene& scene, StepperOptions options) const {
    options.precision = std::get<Precision>(GetParam());
    return make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, options);
  }
};

// The sum of the impulses of the drive and of the bottom wall equals the change of momentum of particles and platen,
// except for rounding.
TEST_P(Platen, KeepsMomentum) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  StepperOptions options = shaking_options(scene);
  const double mass = 0.02, force = -3.0;
  options.boundary = Boundary().load(wall_z_hi, 2, std::make_shared<drives::Ramp>(force, options.dt, 20), mass);
  const auto stepper = make(scene, options);
  double given = 0, largest = 0, before = 0;
  for (int k = 0; k < 100; ++k) {
    const Observation now = stepper->observe();
    before = now.wall_displacement[wall_index(wall_z_hi)].z;
    const double on_bottom = now.wall_force[wall_index(wall_z_lo)].z;
    given += options.dt * (options.boundary.wall[wall_index(wall_z_hi)].axis[2].drive->value(k) - on_bottom);
    largest = std::max(largest, std::abs(given));
    stepper->advance(1);
  }
  const double velocity = (stepper->observe().wall_displacement[wall_index(wall_z_hi)].z - before) / options.dt;
  double momentum = mass * velocity;
  const ParticleState state = stepper->particles();
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) momentum += scene.inertia.mass[i] * state.velocity[i].z;
  // rounding of the forces of about a thousand contacts over a hundred steps, in which the errors partly cancel
  const double rounding = std::get<Precision>(GetParam()) == Precision::double_ ? 0x1p-53 : 0x1p-24;
  EXPECT_NEAR(momentum, given, 300 * rounding * largest);
  EXPECT_GT(largest, 0.1 * std::abs(force) * 100 * options.dt);
}

// With damping, an elastic column under a platen comes to rest at the displacement F/K.
TEST_P(Platen, ComesToRestAtTheStaticDisplacement) {
  const double side = 2e-3, modulus = 3e9;
  const int layers = 3;
  const HandMade made = cubic_lattice_network(1, 1, layers, side, 2e-5);
  Laws laws;
  laws[static_cast<std::size_t>(PairType::mm)] = laws::Elastic{modulus, 0.2};
  laws[static_cast<std::size_t>(PairType::mw)] = laws::Elastic{modulus, 0};
  const TestScene scene{made.specimen, made.network, laws, made.inertia};
  StepperOptions options;
  options.geometry = Geometry::fixed;
  const double mass = 2e-5;
  options.dt = 0.3 * critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  options.damping_kind = Damping::local;
  options.damping = 0.7;
  const double force = -2.0;
  options.boundary = Boundary().load(wall_z_hi, 2, std::make_shared<drives::Ramp>(force, options.dt, 100), mass);
  const auto stepper = make(scene, options);
  stepper->advance(4000);
  // The contacts are springs in series with the stiffness E·A/d; d is half as long at the two walls.
  const double expected = force / (modulus * side * side / (layers * side));
  const Observation now = stepper->observe();
  EXPECT_NEAR(now.wall_displacement[wall_index(wall_z_hi)].z, expected, 1e-4 * std::abs(expected));
  EXPECT_NEAR(now.wall_force[wall_index(wall_z_hi)].z, -force, 1e-3 * std::abs(force));
  EXPECT_NEAR(now.wall_force[wall_index(wall_z_lo)].z, force, 1e-3 * std::abs(force));
}

INSTANTIATE_TEST_SUITE_P(All, Platen,
                         testing::Combine(all_backends(),
                                          testing::Values(Precision::double_, Precision::mixed, Precision::single)),
                         [](const auto& info) { return name_of_case(info); });

TEST(FixedParticles, StayWhereTheyAreWhateverTheirVelocityWasSetTo) {
  const TestScene scene = make_scene(random_specimen(6));
  for (const Backend backend : {Backend::cpu, Backend::reference}) {
    StepperOptions options = shaking_options(scene);
    options.boundary.fixed = {2};
    const auto stepper = make_stepper(backend, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    stepper->set_velocities(std::vector<Vec3d>(scene.specimen.size(), {0.01, 0, 0}),
                            std::vector<Vec3d>(scene.specimen.size(), {0, 1, 0}));
    stepper->advance(20);
    const ParticleState state = stepper->particles();
    EXPECT_EQ(norm(state.displacement[2]), 0);
    EXPECT_EQ(norm(state.rotation[2]), 0);
    EXPECT_GT(norm(state.displacement[3]), 0);
  }
}

// The bytes of a stepper include the weights of the particles and the table of the walls.
TEST(SteppersBytes, CountWeightsAndTheWallsTable) {
  const TestScene scene = make_scene(random_specimen(6));
  StepperOptions options;
  options.dt = 1e-8;
  const auto bytes = [&] {
    return make_stepper(Backend::cpu, scene.specimen, scene.network, scene.laws, scene.inertia, options)->bytes();
  };
  const std::int64_t bare = bytes(), particles = static_cast<std::int64_t>(scene.specimen.size());
  options.boundary.body_force.resize(scene.specimen.size());
  EXPECT_EQ(bytes() - bare, 4 * 8 * particles);
  options.boundary.move(wall_z_hi, 2, std::make_shared<drives::Ramp>(1e-6, options.dt, 5));
  EXPECT_EQ(bytes() - bare, 4 * 8 * particles + 8 * 4 * (kernels::WallTable<double>::most_rows + 1));
}

// A light platen (a wall that moves under a load) on an elastic contact limits the time step. With the contact's
// stiffness k = E·A/d and the platen's mass m, multiplied by the density scaling, the critical step is √(2·m/k).
TEST(PlatenStep, IsCriticalWhereThePlatenIsLight) {
  const HandMade made = cubic_lattice_network(1, 1, 2, 2e-3, 2e-5);
  const Laws laws = same_law(laws::Elastic{3e9, 0.2});
  StepperOptions options;
  options.density_scaling = 4;
  const CriticalStep without = critical_step(made.network, laws, made.inertia, options);
  const double mass = 1e-8;
  options.boundary.load(wall_z_hi, 2, std::make_shared<drives::Ramp>(), mass);
  const CriticalStep with = critical_step(made.network, laws, made.inertia, options);
  const double stiffness = 3e9 * 4e-6 / 1e-3;
  EXPECT_GE(without.particle, 0);
  EXPECT_EQ(with.particle, -1);
  EXPECT_NEAR(with.dt, std::sqrt(2 * 4 * mass / stiffness), 1e-12 * without.dt);
}

TEST(BoundaryInput, IsRefusedByName) {
  const TestScene scene = make_scene(random_specimen(5));
  const auto message = [&](const Boundary& boundary) -> std::string {
    StepperOptions options;
    options.dt = 1e-7;
    options.boundary = boundary;
    try {
      make_stepper(Backend::cpu, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  };
  const auto ramp = std::make_shared<drives::Ramp>(1e-6, 1e-7, 5);
  EXPECT_EQ(message(Boundary().move(wall_x_hi, 1, ramp)), "accepted");
  EXPECT_NE(
      message(Boundary().move(wall_x_hi, 1, std::make_shared<drives::Ramp>(1e-6, 2e-7, 5))).find("wall +x, axis y"),
      std::string::npos);
  EXPECT_NE(message(Boundary().move(wall_y_lo, 0, nullptr)).find("no drive"), std::string::npos);
  EXPECT_NE(message(Boundary().load(wall_z_hi, 2, ramp, 0)).find("mass"), std::string::npos);
  Boundary platen;
  platen.load(wall_z_hi, 2, ramp, 1e-6).load(wall_z_hi, 0, ramp, 1e-6).load(wall_x_hi, 0, ramp, 3);
  EXPECT_EQ(message(platen), "accepted");
  try {
    platen.load(wall_z_hi, 1, ramp, 2e-6);
    ADD_FAILURE() << "a platen has one mass";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "boundary: wall +z: mass: found 2e-06 kg, expected 1e-06 kg, the mass given with its axis x");
  }
  EXPECT_NE(
      message(Boundary().move(wall_x_hi, 0,
                              std::make_shared<drives::Table>(1e-7, std::vector{0.0, 1.0}, std::vector{1e-6, 2e-6})))
          .find("found 1e-06 m, expected 0"),
      std::string::npos);
  Boundary fixed;
  fixed.fixed = {-1};
  EXPECT_NE(message(fixed).find("fixed particle"), std::string::npos);
  Boundary weight;
  weight.body_force.resize(3);
  EXPECT_NE(message(weight).find("body forces"), std::string::npos);
}

}  // namespace
}  // namespace macadam::test
