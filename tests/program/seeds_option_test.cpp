// SPDX-License-Identifier: GPL-3.0-or-later
// seeds_option_test.cpp  Tests the scenes and options that `macadam run --seeds` refuses, and the arguments that it
// passes to the Python package.
#include <map>

#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

struct SeedsOption : Program {
  void SetUp() override {
    Program::SetUp();
    std::ofstream(folder_ / "made.toml") << "[specimen]\nbox = [0.004, 0.004, 0.004]\nseed = 3\n[specimen.mastic]\n"
                                            "radius = [\"0.4 mm\", \"0.5 mm\"]\ncount = 60\n"
                                            "[loading]\nkind = \"cyclic\"\nfrequencies = [20.0]\n"
                                         << am1_contacts;
    std::ofstream(folder_ / "python") << "#!/bin/sh\n[ \"$1\" = -c ] || echo \"$@\"\n";
    fs::permissions(folder_ / "python", fs::perms::owner_all);
    setenv("MACADAM_PYTHON", (folder_ / "python").c_str(), 1);
  }
  void TearDown() override {
    unsetenv("MACADAM_PYTHON");
    Program::TearDown();
  }
};

TEST_F(SeedsOption, BecomesAStudyOfTheScene) {
  const std::string scene = (folder_ / "made.toml").string();
  const Outcome outcome = macadam("run " + path("made.toml") +
                                  " --out out --seeds 4 --method harmonic --threads 2 --device 0,1 --at-once 3");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "-m macadam study " + scene +
                             " --out out --seeds 4 --first-seed 3 --workers 3 --run-option=--method=harmonic "
                             "--run-option=--threads=2 --run-option=--device=0,1\n");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(SeedsOption, PassesOnTheSceneWithTheValuesOfSet) {
  const std::string out = (folder_ / "out").string();
  const Outcome outcome =
      macadam("run " + path("made.toml") + " --out " + path("out") + " --seeds 2 --set specimen.seed=7");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "-m macadam study " + out + "/scene_as_run.toml --out " + out + " --seeds 2 --first-seed 7\n");
  EXPECT_TRUE(contains(read(folder_ / "out/scene_as_run.toml"), "\nseed = 7\n"));
}

TEST_F(SeedsOption, RefusesScenesWithoutASeedAndOptionsWithoutEffect) {
  write_scene();
  const std::string made = "run " + path("made.toml") + " --out " + path("out") + " --seeds 2";
  for (const auto& [arguments, message] : std::map<std::string, std::string>{
           {"run " + path("scene.toml") + " --out " + path("out") + " --seeds 2",
            "--seeds: found the specimen of the file " + (folder_ / "t8.csv").string() +
                ", which has no seed, expected a scene whose specimen is generated"},
           {made + " --ranks", "--seeds: found --ranks, expected this option without --ranks"},
           {made + " --resume", "--seeds: found --resume, expected the same command without --resume"},
           {made + " " + path("scene.toml"), "--seeds: found 2 scenes, expected one scene"},
           {made + " --set solver.methd=1", "--set solver.methd=1: [solver] methd: found an unknown key"},
           {"run " + path("made.toml") + " --out out --seeds 1",
            "--seeds: found \"1\", expected a whole number from 2 to"}}) {
    const Outcome outcome = macadam(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_TRUE(contains(outcome.err, message)) << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace macadam::test
