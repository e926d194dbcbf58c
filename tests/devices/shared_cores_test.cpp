// SPDX-License-Identifier: GPL-3.0-or-later
// shared_cores_test.cpp  Tests how many threads generate each of several specimens while other specimens wait for
// cores.
#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <atomic>

#include "tests/devices/fake_devices.hpp"
#include "macadam/error.hpp"
#include "macadam/run_many.hpp"

namespace macadam::test {
namespace {

using SharedCores = FakeDevices;

// The process has eight cores, and one of them serves the device. The first two specimens get three cores each. When
// the cells of one specimen are made, this specimen keeps two cores and releases one. The third specimen starts on two
// cores: the released one and the one that was left over.
TEST_F(SharedCores, ASceneGivesHalfOnceItsCellsAreMade) {
  std::vector<SceneJob> jobs;
  for (std::uint64_t seed : {1, 2, 3, 4}) {
    Scene scene = read_scene(MACADAM_EXAMPLES "/demo/scene.toml");
    scene.specimen.seed = seed;
    scene.cyclic().frequencies = {20};
    scene.solver.tolerance = std::nullopt;
    scene.solver.density_scaling = std::vector<double>{1e6};
    scene.solver.backend = Backend::cuda;
    scene.solver.devices = {1};
    jobs.push_back({scene, folder_ / std::to_string(seed)});
  }
  std::array<int, 4> relaxing{}, contacts{};
  std::vector<std::size_t> begun,
      made;  // jobs in the order in which they begin to relax, and in the order in which their cells are made
  std::atomic<bool> all_made = false;
  ManyOptions options;
  options.progress = [&](std::size_t job, const std::string& stage, double) {
    if (stage == "relaxing mastic" && relaxing[job] == 0) relaxing[job] = omp_get_max_threads(), begun.push_back(job);
    if (stage == "contact network") contacts[job] = omp_get_max_threads(), made.push_back(job);
    if (made.size() == jobs.size()) all_made = true;
  };
  options.stop = [&] { return all_made.load(); };
  const int before = omp_get_max_threads();
  omp_set_num_threads(8);
  const std::vector<JobOutcome> outcomes = run_many(jobs, options);
  omp_set_num_threads(before);
  ASSERT_EQ(made.size(), jobs.size());
  ASSERT_EQ(begun.size(), jobs.size());
  EXPECT_EQ(relaxing[begun[0]], 3);
  EXPECT_EQ(relaxing[begun[1]], 3);
  EXPECT_EQ(contacts[made[0]], 2);
  EXPECT_GE(relaxing[begun[2]], 2);
  for (const JobOutcome& outcome : outcomes) EXPECT_THROW(std::rethrow_exception(outcome.error), InterruptedError);
}

}  // namespace
}  // namespace macadam::test
