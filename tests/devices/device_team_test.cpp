// SPDX-License-Identifier: GPL-3.0-or-later
// device_team_test.cpp  One specimen on a team (several devices, each of which steps a part of it) gives the same bits
// as on one device. A device that is named several times takes several parts, so most of these tests need only one
// device.
#include <gtest/gtest.h>

#include <mutex>
#include <thread>

#include "tests/devices/expect_same.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

/// Returns teams of 1 to 8 parts on the first device, and a team of all devices.
std::vector<DeviceList> teams() {
  std::vector<DeviceList> out;
  for (const std::size_t shares : {1u, 2u, 3u, 5u, 8u}) out.emplace_back(shares, 0);
  if (report_backends().devices.size() > 1) out.push_back({every_device});
  return out;
}

struct Case {
  const char* name;
  Precision precision;
  ContactForm form;
  Geometry geometry;
  int multiprocessors;  // 0 means all; with a small number the specimen does not fit into registers and shared memory
  const char* path;
  bool elastic = false;
};

class Team : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (report_backends().devices.empty()) GTEST_SKIP() << report_backends().cuda_status;
    const Case& c = GetParam();
    const Laws laws = c.elastic ? elastic_laws() : am1_laws();
    scene_ = make_scene(random_specimen(3, 16, 16, 20), {}, laws);  // needs more than eight multiprocessors
    options_ = slow_options(scene_);
    options_.precision = c.precision;
    options_.form = c.form;
    options_.geometry = c.geometry;
    options_.multiprocessors = c.multiprocessors;
  }
  std::unique_ptr<Stepper> make(const DeviceList& devices) {
    options_.devices = devices;
    return make_stepper(Backend::cuda, scene_.specimen, scene_.network, scene_.laws, scene_.inertia, options_);
  }

  TestScene scene_;
  StepperOptions options_;
};

TEST_P(Team, TakesTheStepsOfOneDevice) {
  const auto alone = make({0});
  EXPECT_HAS(alone->description(), GetParam().path);
  alone->advance(333);
  const auto state = alone->state();
  for (const DeviceList& devices : teams()) {
    SCOPED_TRACE(to_string(devices));
    const auto team = make(devices);
    // If one device cannot hold the specimen in registers and shared memory, several devices together may be able to.
    const std::string path = GetParam().path;
    if (path != "tiles streamed") { EXPECT_HAS(team->description(), path); }
    if (devices.size() > 1) { EXPECT_HAS(team->description(), "devices " + to_string(devices)); }
    for (const std::int64_t steps : {1, 32, 300}) team->advance(steps);
    expect_same(team->state(), state);
    const auto walls = [](const Stepper& s) {
      const auto force = s.observe().wall_force;
      return std::vector<Vec3d>(force.begin(), force.end());
    };
    expect_same(walls(*team), walls(*alone), "forces on the walls");
    expect_same(team->particles().force, alone->particles().force, "forces on the particles");
    expect_same(team->contacts(scene_.network).force, alone->contacts(scene_.network).force, "forces of the contacts");
    EXPECT_EQ(team->first_divergent(), -1);
  }
}

/// A state saved by one team can be continued by another team.
TEST_P(Team, GoesOnFromTheCheckpointOfAnother) {
  const auto alone = make({0});
  alone->advance(150);
  const auto half = alone->state();
  alone->advance(150);
  const auto whole = alone->state();
  const auto pair = make({0, 0});
  pair->set_state(half);
  pair->advance(75);
  const auto five = make({0, 0, 0, 0, 0});
  five->set_state(pair->state());
  five->advance(75);
  expect_same(five->state(), whole);
}

// Several specimens share one device and take turns with all of its multiprocessors. The specimens have different
// sizes, so each needs a different amount of shared memory.
TEST(SideBySide, SpecimensOfOneDeviceTakeTheirOwnSteps) {
  if (report_backends().devices.empty()) GTEST_SKIP() << report_backends().cuda_status;
  constexpr std::size_t specimens = 3;
  std::vector<TestScene> scenes;
  for (const int width : {14, 15, 16}) scenes.push_back(make_scene(random_specimen(3, 16, width, 20)));
  const auto make = [&](std::size_t k) {
    StepperOptions options = slow_options(scenes[k]);
    options.precision = Precision::mixed;
    return make_stepper(Backend::cuda, scenes[k].specimen, scenes[k].network, scenes[k].laws, scenes[k].inertia,
                        options);
  };
  std::vector<std::vector<StateArray>> alone, together(specimens);
  for (std::size_t k = 0; k < specimens; ++k) {
    const auto stepper = make(k);
    EXPECT_HAS(stepper->description(), "tiles on the chip");
    stepper->advance(2000);
    alone.push_back(stepper->state());
  }
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < specimens; ++k) {
    threads.emplace_back([&, k] {
      try {
        const auto stepper = make(k);
        for (int part = 0; part < 20; ++part) stepper->advance(100);
        together[k] = stepper->state();
      } catch (const std::exception& error) { ADD_FAILURE() << k << ": " << error.what(); }
    });
  }
  for (std::thread& t : threads) t.join();
  for (std::size_t k = 0; k < specimens; ++k) expect_same(together[k], alone[k]);
}

/// The harmonic solver on a team finds the same motion in the same number of iterations as on one device.
TEST(TeamHarmonic, FindsTheMotionOfOneDevice) {
  if (report_backends().devices.empty()) GTEST_SKIP() << report_backends().cuda_status;
  for (const Specimen& specimen : {random_specimen(3, 16, 16, 20), boulders(3)}) {
    const TestScene scene = make_scene(specimen);
    const auto solve = [&](const DeviceList& devices) {
      HarmonicOptions options;
      options.backend = Backend::cuda;
      options.devices = devices;
      Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, options, 10);
      auto found =
          harmonic.solve(std::vector<HarmonicLoad>{{.frequency_hz = 2}, {.frequency_hz = 20, .density_scaling = 1}});
      found.push_back(harmonic.solve(5));  // a single load has its own kernels
      return found;
    };
    const auto alone = solve({0});
    for (const DeviceList& devices : teams()) {
      const auto team = solve(devices);
      ASSERT_EQ(team.size(), alone.size());
      for (std::size_t k = 0; k < alone.size(); ++k) {
        EXPECT_TRUE(team[k].motion == alone[k].motion) << to_string(devices) << ", load " << k;
        EXPECT_EQ(team[k].iterations, alone[k].iterations) << to_string(devices);
      }
    }
  }
}

constexpr auto condensed = ContactForm::condensed, points = ContactForm::points;
constexpr auto fixed = Geometry::fixed, updated = Geometry::updated;
INSTANTIATE_TEST_SUITE_P(
    All, Team,
    testing::Values(Case{"SingleOnTheChip", Precision::single, condensed, fixed, 0, "tiles on the chip"},
                    Case{"MixedOnTheChip", Precision::mixed, condensed, updated, 0, "tiles on the chip"},
                    Case{"SingleStreamed", Precision::single, condensed, updated, 1, "tiles streamed"},
                    Case{"MixedStreamed", Precision::mixed, condensed, fixed, 1, "tiles streamed"},
                    Case{"ElasticOnTheChip", Precision::mixed, condensed, fixed, 0, "tiles on the chip", true},
                    Case{"ElasticStreamed", Precision::single, condensed, fixed, 1, "tiles streamed", true},
                    Case{"DoubleCondensed", Precision::double_, condensed, updated, 0, "two kernels a step"},
                    Case{"DoublePoints", Precision::double_, points, updated, 0, "two kernels a step"},
                    Case{"SinglePoints", Precision::single, points, fixed, 0, "two kernels a step"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace macadam::test
