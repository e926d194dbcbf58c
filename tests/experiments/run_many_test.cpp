// SPDX-License-Identifier: GPL-3.0-or-later
// run_many_test.cpp  Several scenes that run in one process have the same results as separate runs.
#include "macadam/run_many.hpp"

#include <array>
#include <atomic>
#include <cstdlib>

#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

class RunMany : public Program {
 protected:
  /// Writes three scenes whose results differ.
  void SetUp() override {
    Program::SetUp();
    for (const char* frequency : {"5.0", "10.0", "20.0"}) {
      const fs::path file =
          write_scene_of(fmt::format("kind = \"cyclic\"\nfrequencies = [{}]\ncycles = 1\n", frequency),
                         std::string(quick) + "backend = \"cpu\"\n");
      names_.push_back(fmt::format("at_{}", std::atoi(frequency)));
      fs::copy_file(file, folder_ / (names_.back() + ".toml"));
    }
  }
  /// Makes a folder with a plugin of fake devices and returns its path.
  std::string fake_devices() const {
    fs::create_directory(folder_ / "plugins");
    fs::create_symlink(FAKE_DEVICE_PLUGIN, folder_ / "plugins" / "libmacadam_cuda.so");
    return (folder_ / "plugins").string();
  }
  std::string scenes() const {
    std::string out;
    for (const std::string& name : names_) out += path(name + ".toml") + " ";
    return out;
  }
  nlohmann::json results(const fs::path& folder) const {
    return nlohmann::json::parse(read(folder / "summary.json"))["results"];
  }

  std::vector<std::string> names_;
};

TEST_F(RunMany, LeavesEachSceneTheFilesOfARunOfItsOwn) {
  for (const int at_once : {0, 1, 3}) {
    const std::string out = fmt::format("out_{}", at_once);
    const Outcome all = macadam(fmt::format("run {} --out {} --at-once {}", scenes(), path(out), at_once));
    ASSERT_EQ(all.code, 0) << all.err;
    EXPECT_HAS(all.out, "3 scenes | results in");
    for (const std::string& name : names_) {
      EXPECT_HAS(all.out, name + ".toml: cpu");
      if (at_once == 0) {
        const Outcome alone = macadam(fmt::format("run {} --out {}", path(name + ".toml"), path("alone_" + name)));
        ASSERT_EQ(alone.code, 0) << alone.err;
      }
      const fs::path own = folder_ / out / name, expected = folder_ / ("alone_" + name);
      EXPECT_EQ(read(own / "response.csv"), read(expected / "response.csv"));
      EXPECT_EQ(read(own / "specimen.csv"), read(expected / "specimen.csv"));
      auto here = results(own), there = results(expected);
      for (auto* list : {&here, &there}) {
        for (auto& row : *list) row.erase("solve_s");
      }
      EXPECT_EQ(here, there);
    }
  }
}

// The fake device (GPU) computes on the processor. Whatever number of scenes uses it at a time, every scene finishes
// with the same response as on the processor.
TEST_F(RunMany, SharesOutADevice) {
  const Outcome without = macadam(fmt::format("run {} --out {}", scenes(), path("out")));
  ASSERT_EQ(without.code, 0) << without.err;
  ASSERT_EQ(::setenv("MACADAM_PLUGIN_PATH", fake_devices().c_str(), 1), 0);
  for (const int at_once : {1, 2, 3, 9}) {
    const std::string out = fmt::format("out_{}", at_once);
    const Outcome all =
        macadam(fmt::format("run {} --backend cuda --out {} --at-once {}", scenes(), path(out), at_once));
    EXPECT_EQ(all.code, 0) << all.err;
    for (const std::string& name : names_) {
      const auto summary = nlohmann::json::parse(read(folder_ / out / name / "summary.json"));
      EXPECT_EQ(summary["solver"]["backend"], "cuda");
      EXPECT_EQ(read(folder_ / out / name / "response.csv"), read(folder_ / "out" / name / "response.csv"));
    }
  }
  ::unsetenv("MACADAM_PLUGIN_PATH");
}

// If all devices are idle, the scenes are assigned to them in turn.
TEST_F(RunMany, GivesEachDeviceAsMany) {
  const std::string log = (folder_ / "devices").string();
  for (const auto& [name, value] : {std::pair("MACADAM_PLUGIN_PATH", fake_devices()),
                                    std::pair("FAKE_DEVICES", std::string("3")), std::pair("FAKE_DEVICE_LOG", log)}) {
    ASSERT_EQ(::setenv(name, value.c_str(), 1), 0);
  }
  const Outcome all = macadam(fmt::format("run {} --backend cuda --out {} --at-once 1", scenes(), path("out")));
  for (const char* name : {"MACADAM_PLUGIN_PATH", "FAKE_DEVICES", "FAKE_DEVICE_LOG"}) ::unsetenv(name);
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(read(log), "0\n1\n2\n");
}

/// Scenes of different length on several devices give the same results as on a processor.
TEST_F(RunMany, SpreadsScenesThatDifferOverDevices) {
  for (const std::string& name : names_) {
    const std::string frequencies = name == "at_10" ? "20.0" : "5.0, 10.0, 20.0, 40.0";
    fs::copy_file(write_scene_of(fmt::format("kind = \"cyclic\"\nfrequencies = [{}]\ncycles = 1\n", frequencies),
                                 std::string(quick) + "backend = \"cpu\"\n"),
                  folder_ / (name + ".toml"), fs::copy_options::overwrite_existing);
  }
  ASSERT_EQ(macadam(fmt::format("run {} --out {}", scenes(), path("out"))).code, 0);
  for (const auto& [name, value] :
       {std::pair("MACADAM_PLUGIN_PATH", fake_devices()), std::pair("FAKE_DEVICES", std::string("2"))}) {
    ASSERT_EQ(::setenv(name, value.c_str(), 1), 0);
  }
  const Outcome all = macadam(fmt::format("run {} --backend cuda --out {} --at-once 4", scenes(), path("spread")));
  for (const char* name : {"MACADAM_PLUGIN_PATH", "FAKE_DEVICES"}) ::unsetenv(name);
  EXPECT_EQ(all.code, 0) << all.err;
  for (const std::string& name : names_)
    EXPECT_EQ(read(folder_ / "spread" / name / "response.csv"), read(folder_ / "out" / name / "response.csv"));
}

/// If one scene fails, the other scenes finish.
TEST_F(RunMany, GoesOnWhereOneFails) {
  std::string diverges = read(folder_ / "at_10.toml");
  diverges.replace(diverges.find(quick), std::string(quick).size(), "time_step = 1e-3\n");
  write(folder_ / "at_10.toml", diverges);
  const Outcome all = macadam(fmt::format("run {} --out {}", scenes(), path("out")));
  EXPECT_EQ(all.code, 1);
  EXPECT_HAS(all.err, "at_10.toml: ");
  EXPECT_HAS(all.err, "1 of 3 scenes failed");
  for (const char* name : {"at_5", "at_20"}) EXPECT_EQ(results(folder_ / "out" / name).size(), 1u);
}

/// If one scene is invalid, or if two scenes have the same name, no scene starts.
TEST_F(RunMany, BeginsNoneWhereASceneIsWrong) {
  write(folder_ / "at_20.toml", "nonsense = 1\n");
  const Outcome wrong = macadam(fmt::format("run {} --out {}", scenes(), path("out")));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_HAS(wrong.err, "at_20.toml");
  EXPECT_FALSE(fs::exists(folder_ / "out"));

  const std::string twice = path("at_5.toml") + " " + path("at_5.toml");
  const Outcome same = macadam(fmt::format("run {} --out {}", twice, path("out")));
  EXPECT_EQ(same.code, 2);
  EXPECT_HAS(same.err, "found the scene name \"at_5\", which");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

/// After a stop request no further scene starts.
TEST_F(RunMany, BeginsNoOtherAfterAStop) {
  std::vector<SceneJob> jobs;
  for (const std::string& name : names_)
    jobs.push_back({read_scene(folder_ / (name + ".toml")), folder_ / "out" / name});
  int ended = 0;
  ManyOptions options;
  options.at_once = 1;
  options.stop = [&] { return ended > 0; };
  options.done = [&](std::size_t, const JobOutcome&) { ++ended; };
  const auto outcomes = run_many(jobs, options);
  ASSERT_EQ(outcomes.size(), 3u);
  EXPECT_TRUE(outcomes[0].result.has_value());
  for (const std::size_t k : {1u, 2u}) {
    EXPECT_FALSE(outcomes[k].result);
    EXPECT_THROW(std::rethrow_exception(outcomes[k].error), InterruptedError);
    EXPECT_FALSE(fs::exists(jobs[k].out / "summary.json"));
  }
  EXPECT_EQ(ended, 3);
  EXPECT_TRUE(run_many({}).empty());
  options = {};
  options.done = [](std::size_t, const JobOutcome&) { throw std::runtime_error("of the caller"); };
  options.stop = [] { return true; };
  EXPECT_THROW(run_many(jobs, options), std::runtime_error);
  jobs[1].out = jobs[0].out / ".." / "at_5";
  EXPECT_THROW(run_many(jobs), InputError);
}

// A stop interrupts every running scene. Each scene leaves its files and a checkpoint. A scene that is resumed from its
// checkpoint gives the same results, bit by bit.
TEST_F(RunMany, StopsThoseThatRun) {
  std::vector<SceneJob> jobs;
  for (const std::string& name : names_) {
    const fs::path file = folder_ / (name + ".toml");
    std::string scene = read(file);
    scene.replace(scene.find("cycles = 1"), 10, "cycles = 40");
    write(file, scene);
    jobs.push_back({read_scene(file), folder_ / "out" / name});
  }
  std::array<std::atomic<bool>, 3> stepping{};
  ManyOptions options;
  options.at_once = 3;
  options.progress = [&](std::size_t job, const std::string& stage, double) {
    if (stage.find("Hz") != std::string::npos) stepping[job] = true;
  };
  options.stop = [&] { return stepping[0] && stepping[1] && stepping[2]; };
  std::vector<std::string> warnings;
  options.warn = [&](std::size_t, const std::string& warning) { warnings.push_back(warning); };
  for (const JobOutcome& outcome : run_many(jobs, options)) {
    ASSERT_TRUE(outcome.error);
    EXPECT_THROW(std::rethrow_exception(outcome.error), InterruptedError);
  }
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  for (const SceneJob& job : jobs) EXPECT_TRUE(fs::exists(job.out / "checkpoint.h5"));
  options = {};
  options.resume = true;
  for (const JobOutcome& outcome : run_many(jobs, options)) EXPECT_TRUE(outcome.result);
  run(jobs[1].scene, folder_ / "alone");
  EXPECT_EQ(read(jobs[1].out / "response.csv"), read(folder_ / "alone" / "response.csv"));
}

}  // namespace
}  // namespace macadam::test
