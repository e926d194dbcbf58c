// SPDX-License-Identifier: GPL-3.0-or-later
// quasi_static_test.cpp  Tests increments without inertia: a whole specimen against values of an independent program,
// bars that separate at one facet, energies, states, and a linear specimen against its relaxation.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "host/quasi_static/increments.hpp"
#include "macadam/drives/constant_rate.hpp"
#include "macadam/quasi_static.hpp"
#include "macadam/spectrum.hpp"
#include "tests/support/cracking_t8.hpp"

namespace macadam::test {
namespace {

constexpr double height = t8_height, area = t8_area;
constexpr std::size_t driven = wall_index(wall_z_hi);

QuasiStatic quasi_static(const TestScene& scene, const QuasiStaticOptions& options = {}) {
  return {scene.specimen, scene.network, scene.laws, options};
}
QuasiStaticOptions on(Backend backend) {
  QuasiStaticOptions out;
  out.backend = backend;
  return out;
}

/// Tests that run on the CPU and, if there is one, on a device.
class QuasiStaticOn : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Backends, QuasiStaticOn, testing::ValuesIn(tested_backends()),
                         [](const auto& info) { return std::string(to_string(info.param)); });

double stress(const QuasiStatic& q) { return -q.wall_force()[driven].z / area; }

/// Takes an increment of strain in `seconds`.
void pull(QuasiStatic& q, double strain, double seconds) {
  WallIncrement next;
  next.dt = seconds;
  next.wall[driven].z = strain * height;
  const IncrementReport report = q.solve(next);
  ASSERT_TRUE(report.converged) << q.time() << " s, residual " << report.residual;
  q.accept();
}

/// A strain, and the stress there by an independent program [MPa].
struct Known {
  double strain, stress;
};

/// Pulls t8 at a constant rate in increments of 3e-5 and compares with known stresses. The independent program had the
/// same increments; its stresses have six digits, and agree with shorter increments to 1e-4 of the peak.
void compare(double rate, const std::vector<Known>& known, double peak) {
  const TestScene scene = cracking_t8();
  QuasiStatic q = quasi_static(scene);
  constexpr double increment = 3e-5;
  int taken = 0;
  for (const Known& want : known) {
    for (const int end = static_cast<int>(std::lround(std::abs(want.strain) / increment)); taken < end; ++taken) {
      ASSERT_NO_FATAL_FAILURE(pull(q, std::copysign(increment, want.strain), increment / rate));
    }
    EXPECT_NEAR(stress(q) / 1e6, want.stress, 1e-4 * peak) << want.strain;
  }
  // forces are out of balance by 1e-10 at most
  EXPECT_LT(q.energies().imbalance(), 1e-9);
  EXPECT_LT(q.energies().increment_error(), 1e-3);
}

TEST(QuasiStaticSpecimen, HasTheKnownCurveAtAHighRate) {
  compare(1,
          {{6e-5, 0.605861},
           {3e-4, 1.05420},
           {6e-4, 1.21794},
           {9e-4, 1.29691},
           {1.2e-3, 1.33667},
           {1.5e-3, 1.34331},
           {2.1e-3, 1.24763},
           {3e-3, 1.04186}},
          1.3458);
}

TEST(QuasiStaticSpecimen, HasTheKnownCurveAtALowRate) {
  compare(0.01,
          {{6e-5, 0.589681}, {3e-4, 1.00486}, {9e-4, 1.20219}, {1.5e-3, 1.26025}, {2.1e-3, 1.27867}, {3e-3, 1.26995}},
          1.2801);
}

// In compression faces slide with friction, and the tangent is not symmetric.
TEST(QuasiStaticSpecimen, HasTheKnownCurveInCompression) {
  compare(1, {{-3e-4, -3.309}, {-6e-4, -5.922}, {-9e-4, -8.166}, {-1.5e-3, -11.889}}, 11.889);
}

// The wall reverses twice, so that cracks close and open again. The known stresses have an error of 1e-3.
TEST(QuasiStaticSpecimen, ClosesAndOpensAgain) {
  const TestScene scene = cracking_t8();
  QuasiStatic q = quasi_static(scene);
  constexpr double increment = 1.52e-5;
  const double turns[] = {1.5e-3, 1.5e-3 + 1.8e-3};
  const std::vector<Known> known{{1.5048e-3, 1.3435}, {2.4928e-3, 0.4470}, {3.2984e-3, -3.2593}, {3.9976e-3, 0.3478}};
  double now = 0, wall = 0;
  const auto wall_at = [&](double t) {
    return t < turns[0] ? t : t < turns[1] ? 2 * turns[0] - t : t - 2 * (turns[1] - turns[0]);
  };
  for (const Known& want : known) {
    while (now < want.strain - 1e-9) {
      now += increment;
      const double next = wall_at(now);
      ASSERT_NO_FATAL_FAILURE(pull(q, next - wall, increment));
      wall = next;
    }
    EXPECT_NEAR(stress(q) / 1e6, want.stress, 2e-3 * 1.3435) << now;
  }
}

// The weakest facet takes G_f·A, and nothing else is damaged, for any length of the bar.
TEST_P(QuasiStaticOn, TakesTheFractureEnergyOfABar) {
  for (const int facets : {2, 4, 8}) {
    const TestScene scene = cracking_bar(facets);
    quasi_static::CourseOptions options;
    options.drive = std::make_shared<drives::ConstantRate>(1e-4, 1e-6, 1);  // the crack is separated at 6.1e-5 m
    options.height = facets * 2e-3, options.area = 4e-6, options.grows = true;
    options.stops = {1'000'000}, options.first = 100;
    options.solver = on(GetParam());
    quasi_static::Increments increments(scene.specimen, scene.network, scene.laws, options);
    while (increments.step() < options.stops.back()) increments.advance();
    const QuasiStatic& q = increments.network();
    const double right = 60 * 4e-6;
    // the energy of damage is a function of the state; the work has the error of the increments besides
    EXPECT_NEAR(q.energies().crack_j, right, 1e-8 * right);
    EXPECT_NEAR(q.energies().work_j, right, 1e-3 * right);
    EXPECT_LT(q.energies().imbalance(), 1e-9);
    int damaged = 0;
    for (const laws::PointCrack& crack : q.point_cracks()) damaged += crack.damage > 0;
    EXPECT_EQ(damaged, 5);
    EXPECT_NEAR(q.wall_force()[driven].z, 0, 1e-6);  // against a strength of 8 N
  }
}

// A specimen that goes on from a state takes the same increments to the bit.
TEST(QuasiStaticState, ContinuesToTheSameBits) {
  const TestScene scene = cracking_t8();
  QuasiStaticOptions by_iterations;
  by_iterations.direct_below = 0, by_iterations.residual = 1e-7;
  for (const QuasiStaticOptions& options : {QuasiStaticOptions{}, by_iterations}) {
    QuasiStatic whole = quasi_static(scene, options), first = quasi_static(scene, options),
                second = quasi_static(scene, options);
    for (int k = 0; k < 6; ++k) pull(whole, 6e-5, 6e-5);
    for (int k = 0; k < 4; ++k) pull(first, 6e-5, 6e-5);
    second.set_state(first.state());
    for (int k = 0; k < 2; ++k) pull(second, 6e-5, 6e-5);
    // The iterative solver keeps a preconditioner from earlier increments, so it agrees to its tolerance only
    const double tolerance = options.direct_below > 0 ? 0 : 1e-6;
    EXPECT_NEAR(stress(second), stress(whole), tolerance * stress(whole));
    EXPECT_NEAR(second.energies().crack_j, whole.energies().crack_j, tolerance * whole.energies().crack_j);
  }
}

TEST(QuasiStaticState, HasTheSameBitsWithAnyNumberOfThreads) {
  const TestScene scene = cracking_t8();
  QuasiStaticOptions by_iterations;
  by_iterations.direct_below = 0, by_iterations.residual = 1e-7;
  const int before = omp_get_max_threads();
  for (const QuasiStaticOptions& options : {QuasiStaticOptions{}, by_iterations}) {
    std::vector<std::vector<StateArray>> states;
    for (const int threads : {1, 2}) {
      omp_set_num_threads(threads);
      QuasiStatic q = quasi_static(scene, options);
      for (int k = 0; k < 3; ++k) pull(q, 1.2e-4, 1.2e-4);
      EXPECT_GT(q.energies().crack_j, 0);
      states.push_back(q.state());
    }
    EXPECT_EQ(states[0].size(), states[1].size());
    for (std::size_t k = 0; k < std::min(states[0].size(), states[1].size()); ++k)
      EXPECT_TRUE(states[0][k].values == states[1][k].values) << states[0][k].name;
  }
  omp_set_num_threads(before);
}

// Both linear solvers find the same equilibrium.
TEST(QuasiStaticSolvers, Agree) {
  const TestScene scene = cracking_t8();
  QuasiStaticOptions by_iterations;
  by_iterations.direct_below = 0, by_iterations.residual = 1e-9;
  QuasiStatic direct = quasi_static(scene), iterative = quasi_static(scene, by_iterations);
  for (int k = 0; k < 10; ++k) {
    ASSERT_NO_FATAL_FAILURE(pull(direct, 6e-5, 6e-5));
    ASSERT_NO_FATAL_FAILURE(pull(iterative, 6e-5, 6e-5));
  }
  EXPECT_NEAR(stress(iterative), stress(direct), 1e-7 * stress(direct));
}

// The top wall carries the given load, at once and while the specimen creeps.
TEST_P(QuasiStaticOn, CarriesALoad) {
  const TestScene scene = make_scene(random_specimen(4));
  QuasiStatic q = quasi_static(scene, on(GetParam()));
  double before = 0;
  for (int k = 0; k < 5; ++k) {
    WallIncrement next;
    next.dt = k == 0 ? 1e-6 : 0.1;
    next.load = 10;
    ASSERT_TRUE(q.solve(next).converged) << k;
    q.accept();
    EXPECT_NEAR(q.wall_force()[driven].z, -10, 1e-7);
    EXPECT_NEAR(q.wall_force()[wall_index(wall_z_lo)].z, 10, 1e-7);
    EXPECT_GT(q.wall_displacement()[driven].z, before);
    before = q.wall_displacement()[driven].z;
  }
  EXPECT_LT(q.energies().imbalance(), 1e-9);
}

// A constant rate, and a linear specimen: the stress is that of the relaxation modulus. The tolerance of the increments
// is 1e-4, that of the spectrum 1e-5.
TEST_P(QuasiStaticOn, FollowsTheRelaxationOfTheSpecimen) {
  const TestScene scene = make_scene(random_specimen(4));
  SpectrumOptions spectrum;
  spectrum.shortest = 0.01, spectrum.longest = 10, spectrum.tolerance = 1e-5;
  const PronySeries relaxation = spectrum_of(scene.specimen, scene.network, scene.laws, spectrum).relaxation;
  const double rate = 1e-4, end = 10;
  const Vec3d size = scene.specimen.box.size;
  quasi_static::CourseOptions options;
  options.drive = std::make_shared<drives::ConstantRate>(rate * size.z, end / 1e6, end);
  options.height = size.z, options.area = size.x * size.y;
  options.grows = true, options.tolerance = 1e-4, options.first = 100;
  options.stops = {1000, 10'000, 100'000, 1'000'000};
  options.solver = on(GetParam());
  quasi_static::Increments increments(scene.specimen, scene.network, scene.laws, options);
  for (const std::int64_t stop : options.stops) {
    while (increments.step() < stop) increments.advance();
    const double t = end * 1e-6 * static_cast<double>(stop);
    const double want = rate * t * relaxation.after_ramp(t, t);
    const double found = -increments.network().wall_force()[driven].z / (size.x * size.y);
    EXPECT_NEAR(found, want, 2e-4 * want) << t;
  }
  EXPECT_LT(increments.report().error, 1e-3);
}

/// Pulls t8 to a strain of 0.003 and returns its stresses at twenty strains [Pa], and the estimate of their error.
std::pair<std::vector<double>, double> pulled_t8(const LawTable& laws, double rate, double tolerance) {
  const TestScene scene = make_scene(read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}}), {}, laws);
  const double end = 0.003 / rate;
  quasi_static::CourseOptions options;
  options.drive = std::make_shared<drives::ConstantRate>(rate * height, end / 1e6, end);
  options.height = height, options.area = area, options.grows = true, options.tolerance = tolerance;
  options.first = 200;
  for (int k = 1; k <= 20; ++k) options.stops.push_back(50'000 * k);
  quasi_static::Increments increments(scene.specimen, scene.network, scene.laws, options);
  std::vector<double> out;
  for (const std::int64_t stop : options.stops) {
    while (increments.step() < stop) increments.advance();
    out.push_back(stress(increments.network()));
  }
  return {out, increments.report().error};
}

// The errors of increments have signs. Their sum is at least the difference from increments of a ten times smaller
// tolerance, and at most ten times this difference. It is too large because it contains the curvature that cracks
// cause, which has no error, and because relaxation forgets errors.
TEST(QuasiStaticSpecimen, EstimatesTheErrorOfItsIncrements) {
  for (const bool cracks : {true, false}) {
    const LawTable laws = cracks ? cracking_t8().laws : am1_laws();
    const double rate = cracks ? 1 : 0.01;
    const auto [coarse, error] = pulled_t8(laws, rate, 1e-3);
    const auto [fine, unused] = pulled_t8(laws, rate, 1e-4);
    double difference = 0, largest = 0;
    for (std::size_t k = 0; k < fine.size(); ++k) {
      difference = std::max(difference, std::abs(coarse[k] - fine[k]));
      largest = std::max(largest, std::abs(fine[k]));
    }
    EXPECT_LT(difference / largest, error) << cracks;
    EXPECT_LT(error, 10 * difference / largest) << cracks;
  }
}

/// Returns a strength test of brittle_t8() at 1e-3 1/s, to a strain of 1e-9 times its last stop.
quasi_static::CourseOptions pulled_brittle(const QuasiStaticOptions& solver, std::vector<std::int64_t> stops) {
  quasi_static::CourseOptions out;
  out.drive = std::make_shared<drives::ConstantRate>(height, 1e-9, 1e-3);
  out.height = height, out.area = area, out.grows = true;
  out.stops = std::move(stops);
  out.solver = solver;
  return out;
}

// After a fall of stress for which no equilibrium exists at a larger displacement of the wall, the opening of cracks
// controls the test, and the displacement decreases.
TEST_P(QuasiStaticOn, FollowsSnapBack) {
  const TestScene scene = brittle_t8();
  const quasi_static::CourseOptions options = pulled_brittle(on(GetParam()), {1'000'000});
  quasi_static::Increments increments(scene.specimen, scene.network, scene.laws, options);
  double peak = 0, furthest = 0, least = 1, last = 1;
  while (increments.report().by_opening < 200 && (last > 0.14e6 || peak < 0.14e6)) {
    increments.advance();
    const double strain = increments.network().wall_displacement()[driven].z / height;
    last = stress(increments.network());
    peak = std::max(peak, last);
    furthest = std::max(furthest, strain);
    if (increments.report().by_opening > 0) least = std::min(least, strain);
  }
  // Known from an independent program: peak 0.845 MPa, largest strain 3.1226e-4 to 3.124e-4, 2.898e-4 at 0.14 MPa
  EXPECT_NEAR(peak / 1e6, 0.845, 1e-3);
  EXPECT_NEAR(furthest, 3.124e-4, 1e-6);
  EXPECT_NEAR(least, 2.898e-4, 2e-6);
  EXPECT_GT(increments.report().by_opening, 5);
  EXPECT_GT(increments.report().residual, 0);
  EXPECT_LE(increments.report().residual, 10 * QuasiStaticOptions{}.residual);
}

// With a solver by iterations the wall does not go back: the stress drops suddenly, while a drag slows the cracks.
// The balance of energies contains the work of the drag.
TEST_P(QuasiStaticOn, DropsSuddenly) {
  const TestScene scene = brittle_t8();
  quasi_static::CourseOptions options = pulled_brittle(on(GetParam()), {315'000, 320'000});
  options.solver.direct_below = 0;
  quasi_static::Increments increments(scene.specimen, scene.network, scene.laws, options);
  double strain = 0, peak = 0;
  while (increments.step() < options.stops.front()) {
    increments.advance();
    const double now = increments.network().wall_displacement()[driven].z / height;
    EXPECT_GT(now, strain);
    strain = now;
    peak = std::max(peak, stress(increments.network()));
  }
  // Known from an independent program: peak 0.845 MPa; under control by the wall it stops at a strain of 3.1226e-4 and
  // 0.305 MPa. The curve becomes vertical there, so the stress depends on the length of the last increment.
  const quasi_static::CourseReport& report = increments.report();
  EXPECT_NEAR(peak / 1e6, 0.845, 1e-3);
  ASSERT_EQ(report.drops, 1);
  EXPECT_NEAR(report.first_drop->strain, 3.1226e-4, 1e-6);
  EXPECT_NEAR(report.first_drop->stress_pa / 1e6, 0.305, 0.02);
  EXPECT_LT(stress(increments.network()), 0.5 * report.first_drop->stress_pa);
  // the residual of 1e-10 is relative to the forces of the contacts; there are some fifty increments
  const QuasiStaticEnergies& energies = increments.network().energies();
  EXPECT_LT(energies.imbalance(), 1e-9);
  EXPECT_GT(energies.damping_j, 1e-3 * energies.work_j);

  // A checkpoint contains the drop, and the test goes on from it to the same result
  quasi_static::Increments resumed(scene.specimen, scene.network, scene.laws, options);
  resumed.set_state(increments.state());
  EXPECT_EQ(resumed.report().drops, 1);
  EXPECT_EQ(resumed.report().first_drop->stress_pa, report.first_drop->stress_pa);
  EXPECT_EQ(resumed.network().energies().damping_j, energies.damping_j);
}

// If the caller wants to stop while the stress drops, the state is again that before the drop, and a second attempt
// finds the same end.
TEST_P(QuasiStaticOn, StopsInADrop) {
  const TestScene scene = brittle_t8();
  quasi_static::CourseOptions options = pulled_brittle(on(GetParam()), {315'000, 320'000});
  options.solver.direct_below = 0;
  int asked = 0;
  bool wanted = true;
  options.stop = [&] { return ++asked > 3 && wanted; };
  quasi_static::Increments increments(scene.specimen, scene.network, scene.laws, options);
  double before = 0;
  const auto advance_to_end = [&] {
    while (increments.step() < options.stops.front()) {
      before = stress(increments.network());
      increments.advance();
    }
  };
  EXPECT_THROW(advance_to_end(), quasi_static::Stopped);
  EXPECT_EQ(stress(increments.network()), before);
  EXPECT_EQ(increments.report().drops, 0);
  EXPECT_EQ(increments.network().energies().damping_j, 0);

  wanted = false;
  advance_to_end();
  options.stop = {};
  quasi_static::Increments whole(scene.specimen, scene.network, scene.laws, options);
  while (whole.step() < options.stops.front()) whole.advance();
  EXPECT_EQ(increments.report().drops, 1);
  // both within the residual of 1e-10; the preconditioner of the first one's iterations is older
  EXPECT_NEAR(stress(increments.network()) / stress(whole.network()), 1, 1e-6);
}

// The work of the drag closes the balance of energies, also in the increment after it, which ends in equilibrium.
TEST_P(QuasiStaticOn, CountsTheWorkOfDrag) {
  const TestScene scene = cracking_t8();
  QuasiStaticOptions options = on(GetParam());
  QuasiStatic network(scene.specimen, scene.network, scene.laws, options);
  WallIncrement next;
  next.dt = 1e-5, next.wall[driven].z = 1e-7, next.drag = 0.5;
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(network.solve(next).converged);
    network.accept();
    EXPECT_GT(network.drag(), 0);
    EXPECT_THROW(network.state(), RunError);
    next.wall[driven].z = 0;
  }
  next.drag = 0;
  ASSERT_TRUE(network.solve(next).converged);
  network.accept();
  EXPECT_EQ(network.drag(), 0);
  EXPECT_GT(network.energies().damping_j, 0.01 * network.energies().work_j);
  EXPECT_LT(network.energies().imbalance(), 1e-9);
}

TEST(QuasiStaticInput, RefusesLawsWithoutATangent) {
  TestScene scene = make_scene(random_specimen(2));
  scene.laws[static_cast<std::size_t>(PairType::mm)] = laws::BrittleBond{};
  EXPECT_THROW(quasi_static(scene), InputError);
}

}  // namespace
}  // namespace macadam::test
