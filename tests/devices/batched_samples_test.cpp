// SPDX-License-Identifier: GPL-3.0-or-later
// batched_samples_test.cpp  Tests stepped runs on a device (GPU), which computes several samples (recorded time steps)
// per call; the processor computes one. The results must be equal bit by bit. This is possible because the device here
// is a fake, which computes on the processor (fake_plugin.cpp).
#include <gtest/gtest.h>

#include <array>

#include "tests/devices/fake_devices.hpp"
#include "macadam/error.hpp"
#include "macadam/simulation.hpp"

namespace macadam::test {
namespace {

class BatchedSamples : public FakeDevices {
 protected:
  /// Reads a scene with the specimen t8. `loading`, `solver` and `output` are the lines of the tables with these names.
  Scene scene(const std::string& loading, const std::string& solver, Backend backend,
              const std::string& output = "") const {
    Scene out = read_scene(write_t8(loading, solver, output));
    out.solver.backend = backend;
    if (backend == Backend::cuda) out.solver.devices = {1};
    return out;
  }
  void expect_same_files(const std::vector<const char*>& files) const {
    for (const char* file : files) EXPECT_EQ(read(out("device") / file), read(out("processor") / file)) << file;
  }
};

const std::string four = "kind = \"cyclic\"\nfrequencies = [5.0, 10.0, 20.0, 40.0]\ncycles = 2\n";
const std::string one = "kind = \"cyclic\"\nfrequencies = [20.0]\ncycles = 2\n";
constexpr const char* quick = "density_scaling = 1e6\n";

/// The response file of the device equals the CPU's response file, and progress is reported for every sample. Some
/// samples need the motion of the sides at their step, for Poisson's ratio.
TEST_F(BatchedSamples, AreThoseOfTheProcessor) {
  const RunResult processor = run(scene(four, quick, Backend::cpu), out("processor"));
  std::vector<double> shares;
  Watcher watcher;
  watcher.progress = [&](const std::string& stage, double share) {
    if (stage.starts_with("40 Hz")) shares.push_back(share);
  };
  const RunResult device = run(scene(four, quick, Backend::cuda), out("device"), watcher);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto ratio = [i](const RunResult& r) {
      return std::get<experiments::SteppedCyclic>(r.found).frequencies.at(i).poisson_ratio;
    };
    ASSERT_TRUE(ratio(processor));
    EXPECT_EQ(*ratio(device), *ratio(processor));
  }
  expect_same_files({"response.csv"});
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
  EXPECT_GT(shares.size(), 900u) << "each sample is told";
}

/// Some frames of fields are due between two samples. Each of the device's field files equals the CPU's file.
TEST_F(BatchedSamples, FramesOfFieldsAreThoseOfTheirSteps) {
  const std::string output = "fields = [\"particles\", \"contacts\"]\nevery = 45\nformat = \"vtp\"\n";
  for (const Backend backend : {Backend::cpu, Backend::cuda})
    run(scene(one, quick, backend, output), out(backend == Backend::cpu ? "processor" : "device"));
  int frames = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out("processor") / "fields")) {
    if (!entry.is_regular_file()) continue;
    const fs::path same = out("device") / entry.path().lexically_relative(out("processor"));
    EXPECT_EQ(read(same), read(entry.path())) << same;
    ++frames;
  }
  EXPECT_GT(frames, 40);
  expect_same_files({"response.csv"});
}

/// A run on the device is interrupted six times and resumed. It must write every sample exactly once.
TEST_F(BatchedSamples, NoneIsLostOrDoubledByInterruptions) {
  const std::string loading = "kind = \"cyclic\"\nfrequencies = [5.0, 20.0]\ncycles = 1\n",
                    solver = "density_scaling = 1e5\n";
  run(scene(loading, solver, Backend::cpu), out("processor"));
  const Scene on_device = scene(loading, solver, Backend::cuda);
  int interrupted = 0;
  for (const int asked : {1, 2, 30, 3, 21, 15, 1'000'000})
    interrupted += run_until(on_device, "device", asked, interrupted > 0);
  EXPECT_EQ(interrupted, 6);
  expect_same_files({"response.csv"});
}

/// The points of a monotonic test are recorded at the steps at which they are due, although the device computes several
/// samples ahead.
TEST_F(BatchedSamples, PointsOfALoadKnowTheStepperOfTheirStep) {
  const std::string loading = "kind = \"monotonic\"\nrate = 0.01\nstrain = 4e-5\npoints = 40\n";
  for (const Backend backend : {Backend::cpu, Backend::cuda}) {
    Scene asked = scene(loading, "method = \"explicit\"\n", backend);
    asked.solver.linear =
        LinearMethod::direct;  // the processor measures the errors, because the fake device has no harmonic solver
    run(asked, out(backend == Backend::cpu ? "processor" : "device"));
  }
  expect_same_files({"monotonic.csv"});
}

/// If several samples of a batch diverge, the message names the first one, as on the processor.
TEST_F(BatchedSamples, TheFirstThatDivergesIsNamed) {
  std::array<std::string, 2> said;
  for (const Backend backend : {Backend::cpu, Backend::cuda}) {
    try {
      run(scene(one, "time_step = 2e-5\ndensity_scaling = 1e3\n", backend), out("out"));
      ADD_FAILURE() << "such steps are not stable";
    } catch (const DivergenceError& error) { said.at(backend == Backend::cuda) = error.what(); }
  }
  EXPECT_EQ(said[0], said[1]);
  EXPECT_HAS(said[0], "at t = ");
}

/// Replaces the callback by which a run asks on which devices to continue. Each call returns the next list in `named`,
/// and records the number of steps that are left.
struct Asked {
  std::vector<DeviceList> named;
  std::vector<std::int64_t> steps;
  Watcher watcher() {
    Watcher out;
    out.devices = [this](std::int64_t left) {
      steps.push_back(left);
      return named.at(steps.size() - 1);
    };
    return out;
  }
};

/// Each frequency runs on the device that the callback names; an empty list keeps the present device. The log must name
/// the device of the start (1), then device 0, then device 1.
TEST_F(BatchedSamples, AFrequencyIsSteppedWhereItIsAskedFor) {
  const Environment log("FAKE_DEVICE_LOG", folder_ / "devices");
  Asked asked{{{}, {0}, {}, {1}}, {}}, never{{}, {}};
  const RunResult moved = run(scene(four, quick, Backend::cuda), out("device"), asked.watcher());
  run(scene(four, quick, Backend::cpu), out("processor"), never.watcher());
  EXPECT_EQ(read(folder_ / "devices"), "1\n0\n1\n");
  expect_same_files({"response.csv"});
  ASSERT_EQ(asked.steps.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    std::int64_t left = 0;
    for (std::size_t l = k; l < 4; ++l) left += moved.stepped().frequencies[l].steps;
    EXPECT_EQ(asked.steps[k], left);
  }
}

/// If the new device has no free memory, the run continues on its old device with the same results. A run that may use
/// only the full device fails.
TEST_F(BatchedSamples, ADeviceThatIsFullIsNoReasonToEnd) {
  const Environment log("FAKE_DEVICE_LOG", folder_ / "devices"), full("FAKE_DEVICE_FULL", "0");
  Asked asked{{{}, {0}}, {}};
  run(scene(four, quick, Backend::cuda), out("device"), asked.watcher());
  run(scene(four, quick, Backend::cpu), out("processor"));
  EXPECT_EQ(asked.steps.size(), 2u);
  EXPECT_EQ(read(folder_ / "devices"), "1\n1\n") << "made a second time, because the first stepper was given up";
  expect_same_files({"response.csv"});
  Asked at_once{{{0}}, {}};
  run(scene(four, quick, Backend::cuda), out("device"), at_once.watcher());
  expect_same_files({"response.csv"});
  Scene only = scene(four, quick, Backend::cuda);
  only.solver.devices = {0};
  EXPECT_THROW(run(only, out("none")), RunError);
}

}  // namespace
}  // namespace macadam::test
