// SPDX-License-Identifier: GPL-3.0-or-later
// run_many_test.cpp  Several scenes in one process: each as if it had been run alone.
#include "macadam/run_many.hpp"

#include "program.hpp"

namespace macadam::test {
namespace {

class RunMany : public Program {
 protected:
  /// Three scenes whose results differ.
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

TEST_F(RunMany, BeginsNoneWhereASceneIsWrong) {
  write(folder_ / "at_20.toml", "nonsense = 1\n");
  const Outcome wrong = macadam(fmt::format("run {} --out {}", scenes(), path("out")));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_HAS(wrong.err, "at_20.toml");
  EXPECT_FALSE(fs::exists(folder_ / "out"));

  const std::string twice = path("at_5.toml") + " " + path("at_5.toml");
  const Outcome same = macadam(fmt::format("run {} --out {}", twice, path("out")));
  EXPECT_EQ(same.code, 2);
  EXPECT_HAS(same.err, "found the name at_5, which");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(RunMany, StopsThoseThatRunAndBeginsNoOther) {
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
  jobs[1].out = jobs[0].out / ".." / "at_5";
  EXPECT_THROW(run_many(jobs), InputError);
}

}  // namespace
}  // namespace macadam::test
