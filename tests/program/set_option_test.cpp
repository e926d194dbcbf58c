// SPDX-License-Identifier: GPL-3.0-or-later
// set_option_test.cpp  Tests the option --set of run, check and specimen, and the scene that it leaves in the folder of
// the results.
#include "macadam/scene.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

struct SetOption : Program {
  Outcome run_set(const std::string& out, const std::string& options) const {
    return run_quick(out, "--backend cpu " + options);
  }
};

TEST_F(SetOption, ChangesTheRunAndLeavesTheSceneAsItWasRun) {
  write_scene();
  const Outcome outcome = run_set("out", "--set 'loading.frequencies=[10.0]' --set solver.method=harmonic");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json found = summary("out");
  EXPECT_EQ(found["set"], (nlohmann::json{"loading.frequencies=[10.0]", "solver.method=harmonic"}));
  EXPECT_EQ(found["results"][0]["frequency_hz"], 10.0);
  EXPECT_EQ(found["solver"]["method"], "harmonic");
  EXPECT_TRUE(contains(outcome.out, "scene_as_run.toml")) << outcome.out;
  // the file is a scene that gives the same results, although its paths start from another folder
  const std::string text = read(folder_ / "out/scene_as_run.toml");
  EXPECT_TRUE(contains(text, "#   --set solver.method=harmonic\n")) << text;
  ASSERT_EQ(macadam("run " + path("out/scene_as_run.toml") + " --out " + path("again") + " --backend cpu").code, 0);
  for (const char* key : {"frequency_hz", "e_star_pa", "phase_deg"})  // the same bits
    EXPECT_EQ(summary("again")["results"][0][key], found["results"][0][key]) << key;
  EXPECT_FALSE(summary("again").contains("set"));
  EXPECT_FALSE(fs::exists(folder_ / "again/scene_as_run.toml"));
}

TEST_F(SetOption, ARunWithoutItRemovesTheSceneOfAnOlderRun) {
  write_scene();
  ASSERT_EQ(run_set("out", "--set solver.method=harmonic").code, 0);
  ASSERT_EQ(run_set("out", "").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/scene_as_run.toml"));
  // but not its own scene
  ASSERT_EQ(run_set("out", "--set solver.method=harmonic").code, 0);
  ASSERT_EQ(macadam("run " + path("out/scene_as_run.toml") + " --out " + path("out") + " --backend cpu").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/scene_as_run.toml"));
}

TEST_F(SetOption, RefusesAValueByTheNameOfTheOptionAndChangesNoFile) {
  write_scene();
  for (const char* command : {"run", "specimen", "check"}) {
    const std::string out = std::string(command) == "check" ? "" : " --out " + path("out");
    const Outcome outcome =
        macadam(std::string(command) + " " + path("scene.toml") + out + " --set solver.methd=harmonic");
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_TRUE(contains(outcome.err,
                         "macadam: --set solver.methd=harmonic: [solver] methd: found an unknown key, expected "
                         "method (the nearest of "))
        << outcome.err;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(SetOption, TheFollowingArgumentIsTheScene) {
  write_scene();
  const Outcome check = macadam("check --set solver.method=harmonic " + path("scene.toml"));
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_TRUE(contains(check.out, "method harmonic")) << check.out;
  EXPECT_TRUE(contains(check.out, "scene_as_run.toml")) << check.out;
}

TEST_F(SetOption, ResumeNeedsTheSameValues) {
  const Scene scene = read_changed_scene(write_scene(), {"loading.cycles=2"});
  Scene on_cpu = scene;
  on_cpu.solver.backend = Backend::cpu;
  ASSERT_TRUE(run_until(on_cpu, "out", 3));
  const Outcome other = run_set("out", "--resume");
  EXPECT_EQ(other.code, 2) << other.err;
  const Outcome same = run_set("out", "--resume --set loading.cycles=2");
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(summary("out")["status"], "done");
}

TEST_F(SetOption, ChangesEveryOneOfSeveralScenes) {
  fs::copy_file(write_scene(), folder_ / "b.toml");
  fs::rename(folder_ / "scene.toml", folder_ / "a.toml");
  const Outcome outcome = macadam("run " + path("a.toml") + " " + path("b.toml") + " --out " + path("out") +
                                  " --backend cpu --set solver.method=harmonic");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"out/a", "out/b"}) EXPECT_EQ(summary(name)["solver"]["method"], "harmonic");
}

}  // namespace
}  // namespace macadam::test
