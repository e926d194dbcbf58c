// SPDX-License-Identifier: GPL-3.0-or-later
// thread_limit_test.cpp  Every part of a job uses the given number of threads. Threads that wait do not use processor
// time.
#include "macadam/thread_limit.hpp"

#include <dlfcn.h>
#include <omp.h>

#include <set>

#include "macadam/calibration.hpp"
#include "macadam/run_many.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

constexpr int outside = 5, inside = 2;  // number of threads of the process, and of the scene

/// Collects the values of omp_get_max_threads() in all parts of a job that call back.
class ThreadLimitOfJobs : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    omp_set_num_threads(outside);
  }
  void TearDown() override {
    EXPECT_EQ(omp_get_max_threads(), outside) << "the earlier number is back";
    omp_set_num_threads(before_);
    Program::TearDown();
  }

  Scene scene_of(SolverMethod method, int threads = inside) const {
    Scene scene = read_scene(write_scene());
    scene.solver.method = method;
    scene.solver.backend = Backend::cpu;
    scene.solver.threads = threads;
    return scene;
  }
  Watcher watcher() {
    Watcher out;
    out.progress = [this](const std::string& stage, double) { look(stage); };
    out.prepared = [this](const Preparation&) { look("prepared"); };
    out.planned = [this](const RunResult&) { look("planned"); };
    out.stop = [this] { return look("solving"), false; };
    return out;
  }
  void look(const std::string& stage) {
    stages_.insert(stage);
    EXPECT_EQ(omp_get_max_threads(), inside) << stage;
  }

  std::set<std::string> stages_;

 private:
  const int before_ = omp_get_max_threads();
};

TEST_F(ThreadLimitOfJobs, SpecimensOfFilesAndRecipes) {
  const auto progress = watcher().progress;
  prepare(scene_of(SolverMethod::harmonic), progress);
  EXPECT_TRUE(stages_.contains("tessellation") && stages_.contains("contact network"));
  Scene scene = read_scene(MACADAM_EXAMPLES "/stepped_creep/scene.toml");
  scene.solver.threads = inside;
  prepare(scene, progress);
  EXPECT_TRUE(stages_.contains("relaxing mastic")) << testing::PrintToString(stages_);
  prepare_into(folder_ / "specimen", scene, {}, progress);
}

TEST_F(ThreadLimitOfJobs, SteppedAndHarmonicRuns) {
  for (const SolverMethod method : {SolverMethod::harmonic, SolverMethod::explicit_}) {
    stages_.clear();
    run(scene_of(method), folder_ / "out", watcher());
    EXPECT_TRUE(stages_.contains("planned") && stages_.contains("solving")) << testing::PrintToString(stages_);
  }
}

/// The direct solver is itself parallel, so it calls BLAS with a single thread.
TEST_F(ThreadLimitOfJobs, FactorsHaveOneThreadOfBlas) {
  using Get = int();
  auto* const threads = reinterpret_cast<Get*>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  if (!threads) GTEST_SKIP() << "the BLAS is not OpenBLAS";
  if (std::getenv("OPENBLAS_NUM_THREADS")) GTEST_SKIP() << "the user sets them";
  for (const int given : {1, 4}) {
    Scene scene = scene_of(SolverMethod::harmonic, given);
    scene.solver.linear = LinearMethod::direct;
    run(scene, folder_ / std::to_string(given));
    EXPECT_EQ(threads(), 1);
  }
  const auto modulus = [&](int given) { return summary(std::to_string(given)).at("results").at(0).at("e_star_pa"); };
  EXPECT_EQ(modulus(1).dump(), modulus(4).dump());
}

TEST_F(ThreadLimitOfJobs, Calibrations) {
  ModulusData data;
  data.points.push_back({.frequency_hz = 20, .e_star_pa = 1e10, .phase_deg = 10});
  CalibrationOptions options;
  options.free = {{"M-M.delta", {}, {}, {}, 0}};
  calibrate(scene_of(SolverMethod::harmonic), data, options, watcher());
  EXPECT_TRUE(stages_.contains("solving")) << testing::PrintToString(stages_);
}

// Five cores are divided between two scenes, so each gets two cores; the first scene is limited to a single thread.
TEST_F(ThreadLimitOfJobs, SeveralScenesAtOnce) {
  const std::vector<SceneJob> jobs = {{scene_of(SolverMethod::harmonic, 1), folder_ / "a"},
                                      {scene_of(SolverMethod::harmonic, 0), folder_ / "b"}};
  ManyOptions options;
  std::array<std::set<int>, 2> seen;
  options.progress = [&](std::size_t job, const std::string&, double) { seen[job].insert(omp_get_max_threads()); };
  for (const JobOutcome& outcome : run_many(jobs, options)) EXPECT_FALSE(outcome.error);
  EXPECT_EQ(seen[0], std::set<int>{1});
  EXPECT_EQ(seen[1], std::set<int>{2});
}

/// OpenMP prints its settings when it is loaded. If the program restarts itself, OpenMP prints them again, and the last
/// report counts.
using WaitPolicy = Program;

std::string spins(const fs::path& folder, const std::string& environment) {
  const fs::path err = folder / "environment.txt";
  const std::string command =
      fmt::format("env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT OMP_DISPLAY_ENV=verbose {} '{}' new '{}' 2>'{}' >&2",
                  environment, MACADAM_PROGRAM, (folder / "new.toml").string(), err.string());
  EXPECT_EQ(std::system(command.c_str()), 0) << read(err);
  fs::remove(folder / "new.toml");
  std::string out = "nothing";
  for (const std::string& line : lines_of(read(err)))
    if (const auto at = line.find("GOMP_SPINCOUNT = "); at != std::string::npos) out = line.substr(at + 17);
  return out;
}

TEST_F(WaitPolicy, IsPassiveUnlessTheUserSaysOtherwise) {
  if (spins(folder_, "GOMP_SPINCOUNT=7") == "nothing") GTEST_SKIP() << "this OpenMP does not report it";
  EXPECT_EQ(spins(folder_, ""), "'0'");
  EXPECT_EQ(spins(folder_, "GOMP_SPINCOUNT=7"), "'7'");
  EXPECT_NE(spins(folder_, "OMP_WAIT_POLICY=active"), "'0'");
  EXPECT_EQ(spins(folder_, "MACADAM_RESTARTED=1"), "'0'") << "inherited from a program that started this one";
}

}  // namespace
}  // namespace macadam::test
