// SPDX-License-Identifier: GPL-3.0-or-later
// device_ranks_test.cpp  One specimen on several ranks (processes that share the work) gives the same bits as on one
// rank. Here the ranks are threads that use one device (GPU); tests/ranks/run uses processes, MPI and NCCL.
#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "tests/devices/expect_same.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_files.hpp"
#include "tests/devices/thread_ranks.hpp"

namespace macadam::test {
namespace {

struct Case {
  const char* name;
  Precision precision;
  ContactForm form;
  Geometry geometry;
  bool pushed;  // loads act on a wall and on the particles; otherwise the motion of a wall is prescribed
  const char* path;
};

class RanksOf : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (report_backends().devices.empty()) GTEST_SKIP() << report_backends().cuda_status;
    const Case& c = GetParam();
    scene_ = make_scene(random_specimen(3, 16, 16, 20));
    options_ = slow_options(scene_);
    options_.precision = c.precision;
    options_.form = c.form;
    options_.geometry = c.geometry;
    options_.devices = {0};
    options_.multiprocessors = 1;  // one multiprocessor cannot hold the specimen in registers and shared memory
    if (!c.pushed) return;
    const double mass = std::accumulate(scene_.inertia.mass.begin(), scene_.inertia.mass.end(), 0.0);
    options_.boundary = {};
    options_.boundary.load(wall_z_hi, 2, std::make_shared<drives::Ramp>(-10.0, options_.dt, 50), mass);
    for (const double m : scene_.inertia.mass) options_.boundary.body_force.push_back({0, 100 * m, -981 * m});
    options_.boundary.fixed = {5};
  }
  std::unique_ptr<Stepper> make(Ranks* ranks = nullptr) const {
    StepperOptions options = options_;
    options.ranks = ranks;
    return make_stepper(Backend::cuda, scene_.specimen, scene_.network, scene_.laws, scene_.inertia, options);
  }

  TestScene scene_;
  StepperOptions options_;
};

template <std::size_t n>
std::vector<Vec3d> list(const std::array<Vec3d, n>& of) {
  return {of.begin(), of.end()};
}

/// Several ranks take the same steps as one rank: walls, states, and forces on particles and contacts are equal bit by
/// bit.
TEST_P(RanksOf, TakeTheStepsOfOne) {
  const auto alone = make();
  EXPECT_HAS(alone->description(), GetParam().path);
  for (const std::int64_t steps : {1, 32, 300}) alone->advance(steps);
  const auto state = alone->state();
  const Observation seen = alone->observe();
  const ParticleState particles = alone->particles();
  const ContactState contacts = alone->contacts(scene_.network);
  for (const int count : {2, 3, 8}) {
    for_ranks(count, [&](Ranks& rank) {
      SCOPED_TRACE(std::to_string(rank.number()) + " of " + std::to_string(count));
      const auto part = make(&rank);
      EXPECT_HAS(part->description(), std::to_string(count) + " ranks");
      EXPECT_HAS(part->description(), GetParam().path);
      for (const std::int64_t steps : {1, 32, 300}) part->advance(steps);
      const Observation now = part->observe();  // observed before the state is gathered
      expect_same(list(now.wall_force), list(seen.wall_force), "forces on the walls");
      expect_same(list(now.wall_displacement), list(seen.wall_displacement), "displacements of the walls");
      expect_same(list(now.wall_velocity), list(seen.wall_velocity), "velocities of the walls");
      EXPECT_EQ(part->first_divergent(), -1);
      expect_same(part->state(), state);
      expect_same(part->particles().force, particles.force, "forces on the particles");
      expect_same(part->contacts(scene_.network).force, contacts.force, "forces of the contacts");
    });
  }
}

/// A state saved by one number of ranks can be continued by another number.
TEST_P(RanksOf, GoOnFromACheckpointOfAnotherNumber) {
  const auto alone = make();
  alone->advance(150);
  const auto half = alone->state();
  alone->advance(150);
  const auto whole = alone->state();
  std::vector<StateArray> later;
  for_ranks(2, [&](Ranks& rank) {
    const auto part = make(&rank);
    part->set_state(half);
    part->advance(75);
    auto state = part->state();
    if (rank.number() == 1) later = std::move(state);
  });
  for_ranks(5, [&](Ranks& rank) {
    const auto part = make(&rank);
    part->set_state(later);
    part->advance(75);
    expect_same(part->state(), whole);
  });
}

// Makes a new stepper from one that has taken steps, as a cyclic test does for its next frequency.
TEST_P(RanksOf, BeginAnew) {
  const auto alone = make();
  alone->advance(100);
  const auto state = alone->state();
  for_ranks(3, [&](Ranks& rank) {
    auto part = make(&rank);
    part->advance(37);
    StepperOptions options = options_;
    options.ranks = &rank;
    part = make_stepper(Backend::cuda, scene_.specimen, scene_.network, scene_.laws, scene_.inertia, options,
                        std::move(part));
    part->advance(100);
    expect_same(part->state(), state);
  });
}

// Starts from the steady state of the harmonic solution, as a cyclic test with a tolerance does.
TEST(Ranks, BeginInTheSteadyState) {
  if (report_backends().devices.empty()) GTEST_SKIP() << report_backends().cuda_status;
  const TestScene scene = make_scene(random_specimen(3, 16, 16, 20));
  StepperOptions options;
  options.precision = Precision::mixed;
  options.density_scaling = 10;
  options.devices = {0};
  options.multiprocessors = 1;
  options.observed_every = 40;
  drives::Cyclic loading{1e-4 * scene.specimen.box.size.z, 20, 1, 0};
  const double limit = critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  loading.steps_per_period = 40 * std::llround(std::ceil(1 / (0.8 * limit * loading.frequency * 40)));
  options.boundary = moving_top(loading);
  options.dt = loading.dt();
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, loading.frequency);
  const StartState start =
      steady_start(scene.network, scene.laws, harmonic.solve(20, options.density_scaling).motion, loading);
  options.start = &start;
  const auto stepped = [&](Ranks* ranks) {
    StepperOptions given = options;
    given.ranks = ranks;
    const auto stepper = make_stepper(Backend::cuda, scene.specimen, scene.network, scene.laws, scene.inertia, given);
    EXPECT_HAS(stepper->description(), "tiles streamed");
    for (int k = 0; k < 10; ++k) stepper->advance(40);
    return stepper->state();
  };
  const auto alone = stepped(nullptr);
  for_ranks(3, [&](Ranks& rank) { expect_same(stepped(&rank), alone); });
}

/// Expects that two ranks are refused with the message `why`. Each rank makes a stepper, after `change` has altered the
/// options for this rank, and takes 10 + more(rank) steps.
void expect_refused(const std::string& why, const std::function<void(int rank, StepperOptions& options)>& change,
                    const std::function<std::int64_t(int rank)>& more) {
  const TestScene scene = make_scene(random_specimen(3, 8, 8, 8));
  for_ranks(2, [&](Ranks& rank) {
    StepperOptions options = slow_options(scene);
    options.devices = {0};
    options.ranks = &rank;
    change(rank.number(), options);
    try {
      make_stepper(Backend::cuda, scene.specimen, scene.network, scene.laws, scene.inertia, options)
          ->advance(10 + more(rank.number()));
      ADD_FAILURE() << "was not refused";
    } catch (const Error& error) { EXPECT_HAS(error.what(), why); }
  });
}

// Ranks with different options or numbers of steps would wait for each other forever or step different specimens, so
// they are refused.
TEST(Ranks, ThatDifferAreRefused) {
  if (report_backends().devices.empty()) GTEST_SKIP() << report_backends().cuda_status;
  const auto as_it_is = [](int, StepperOptions&) {};
  const auto none = [](int) { return std::int64_t{0}; };
  expect_refused(
      "checksum of time step, masses and start", [](int rank, StepperOptions& o) { o.density_scaling = 1 + rank; },
      none);
  expect_refused("the number of time steps to take: found 10 and 11, expected the same value on all ranks", as_it_is,
                 [](int rank) { return std::int64_t{rank}; });
  expect_refused(
      "beside 2 ranks, expected one device per rank",
      [](int, StepperOptions& o) {
        o.devices = {0, 0};
      },
      none);
}

/// If particles of several ranks diverge in the same run, all ranks name the same particle.
TEST(Ranks, NameTheFirstParticleThatDiverges) {
  if (report_backends().devices.empty()) GTEST_SKIP() << report_backends().cuda_status;
  const TestScene scene = make_scene(random_specimen(3, 8, 8, 8));
  const std::size_t n = scene.specimen.size();
  for (const std::size_t fast : {std::size_t{3}, n / 2, n - 1}) {
    for_ranks(3, [&](Ranks& rank) {
      StepperOptions options = slow_options(scene);
      options.devices = {0};
      options.ranks = &rank;
      const auto part = make_stepper(Backend::cuda, scene.specimen, scene.network, scene.laws, scene.inertia, options);
      std::vector<Vec3d> velocity(n), spin(n);
      velocity[fast] = velocity[n - 1] = {1e12, 0, 0};
      part->set_velocities(velocity, spin);
      EXPECT_EQ(part->first_divergent(), static_cast<std::int64_t>(fast));
    });
  }
}

constexpr auto condensed = ContactForm::condensed, points = ContactForm::points;
constexpr auto fixed = Geometry::fixed, updated = Geometry::updated;
INSTANTIATE_TEST_SUITE_P(
    All, RanksOf,
    testing::Values(Case{"SingleStreamed", Precision::single, condensed, updated, false, "tiles streamed"},
                    Case{"MixedStreamed", Precision::mixed, condensed, fixed, false, "tiles streamed"},
                    Case{"DoubleCondensed", Precision::double_, condensed, updated, false, "two kernels a step"},
                    Case{"DoublePoints", Precision::double_, points, updated, true, "two kernels a step"},
                    Case{"MixedPushed", Precision::mixed, condensed, updated, true, "two kernels a step"},
                    Case{"SinglePoints", Precision::single, points, fixed, false, "two kernels a step"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace macadam::test
