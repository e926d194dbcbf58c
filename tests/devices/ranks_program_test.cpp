// SPDX-License-Identifier: GPL-3.0-or-later
// ranks_program_test.cpp  Tests the program when mpirun starts it as several ranks (processes that share the work):
// which rank writes files, and that all ranks end together. The device of each rank is a fake, which computes on the
// processor and steps the whole specimen. device_ranks_test.cpp and tests/ranks/run test devices that divide a
// specimen.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class RanksProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    plugins_ = folder_ / "plugins";
    fs::create_directory(plugins_);
    fs::create_directory(folder_ / "tmp");
    use(FAKE_DEVICE_PLUGIN);
    fs::create_symlink(RANKS_PLUGIN, plugins_ / "libmacadam_ranks.so");
  }
  void use(const fs::path& cuda) const {
    fs::remove(plugins_ / "libmacadam_cuda.so");
    fs::create_symlink(cuda, plugins_ / "libmacadam_cuda.so");
  }

  /// Returns the shell command that runs two processes. The command stops the processes after ten minutes. Without a
  /// fault they end much earlier.
  std::string command(const std::string& arguments) const {
    return fmt::format(
        "MACADAM_PLUGIN_PATH='{}' TMPDIR='{}' OMPI_ALLOW_RUN_AS_ROOT=1 "
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 3600 '{}' --oversubscribe -n 2 '{}' {} >'{}' 2>'{}' </dev/null",
        plugins_.string(), (folder_ / "tmp").string(), MPIRUN, MACADAM_PROGRAM, arguments,
        (folder_ / "stdout.txt").string(), (folder_ / "stderr.txt").string());
  }
  Outcome together(const std::string& arguments) const {
    const int status = std::system(command(arguments).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(folder_ / "stdout.txt"), read(folder_ / "stderr.txt")};
  }
  static std::size_t count(const std::string& text, const std::string& part) {
    std::size_t out = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++out;
    return out;
  }
  /// Returns whether the scratch folder of the second rank is removed.
  bool scratch_is_gone() const {
    for (const auto& entry : fs::directory_iterator(folder_ / "tmp")) {
      if (entry.path().filename().string().starts_with("macadam-rank")) return false;
    }
    return true;
  }

  fs::path plugins_;
};

TEST_F(RanksProgram, WritesOnce) {
  write_scene(quick, "[output]\nfields = [\"particles\", \"contacts\"]\nformat = \"vtp\"\n");
  const Outcome alone = run_quick("alone");
  ASSERT_EQ(alone.code, 0) << alone.err;
  const Outcome two = together(fmt::format("run {} --ranks --out {}", path("scene.toml"), path("two")));
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_EQ(count(two.out, "E*"), count(alone.out, "E*")) << two.out;
  EXPECT_EQ(read(folder_ / "two" / "response.csv"), read(folder_ / "alone" / "response.csv"));
  EXPECT_EQ(read(folder_ / "two" / "specimen.csv"), read(folder_ / "alone" / "specimen.csv"));
  for (const auto& field : fs::directory_iterator(folder_ / "alone" / "fields")) {
    const fs::path other = folder_ / "two" / "fields" / field.path().filename();
    EXPECT_EQ(read(other), read(field.path())) << other;
  }
  EXPECT_EQ(summary("two")["status"], "done");
  EXPECT_TRUE(scratch_is_gone());
}

TEST_F(RanksProgram, IsInterruptedAndGoesOn) {
  write_scene("density_scaling = 10.0\n");
  std::atomic<bool> ended = false;
  std::thread told([&] {  // interrupts one of the two ranks
    const fs::path response = folder_ / "two" / "response.csv";
    constexpr std::uintmax_t some_samples = 2000;  // size of the file in bytes
    std::error_code error;
    const auto steps = [&] {
      const std::uintmax_t bytes = fs::file_size(response, error);
      return !error && bytes > some_samples;
    };
    while (!ended && !steps()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (ended) return;
    const std::string kill = fmt::format("pkill -INT -n -f -- '^{} run {}'", MACADAM_PROGRAM, folder_.string());
    EXPECT_EQ(std::system(kill.c_str()), 0);
  });
  const Outcome two = together(fmt::format("run {} --ranks --out {}", path("scene.toml"), path("two")));
  ended = true;
  told.join();
  EXPECT_EQ(two.code, 1) << two.out << two.err;
  EXPECT_THAT(two.err, HasSubstr("--resume continues from it"));
  EXPECT_EQ(count(two.err, "interrupted at"), 1u) << two.err;
  ASSERT_TRUE(fs::exists(folder_ / "two" / "checkpoint.h5"));
  EXPECT_TRUE(scratch_is_gone());
  const Outcome on = together(fmt::format("run {} --ranks --out {} --resume", path("scene.toml"), path("two")));
  ASSERT_EQ(on.code, 0) << on.err;
  const Outcome alone = run_quick("alone");
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(read(folder_ / "two" / "response.csv"), read(folder_ / "alone" / "response.csv"));
}

// An error that occurs on all ranks is printed once.
TEST_F(RanksProgram, FailsAsOne) {
  const Outcome missing = together(fmt::format("run {} --ranks --out {}", path("none.toml"), path("two")));
  EXPECT_EQ(missing.code, 2) << missing.err;
  EXPECT_EQ(count(missing.err, "none.toml"), 1u) << missing.err;
  write_scene();
  const Outcome harmonic =
      together(fmt::format("run {} --ranks --method harmonic --out {}", path("scene.toml"), path("two")));
  EXPECT_EQ(harmonic.code, 2) << harmonic.err;
  EXPECT_THAT(harmonic.err, HasSubstr("one process solves the frequency domain"));
  const Outcome processor =
      together(fmt::format("run {} --ranks --backend cpu --out {}", path("scene.toml"), path("two")));
  EXPECT_EQ(processor.code, 2) << processor.err;
  EXPECT_THAT(processor.err, HasSubstr("cpu with 2 ranks, expected cuda"));
  fs::copy_file(folder_ / "scene.toml", folder_ / "other.toml");
  const Outcome several =
      together(fmt::format("run {} {} --ranks --out {}", path("scene.toml"), path("other.toml"), path("two")));
  EXPECT_EQ(several.code, 2) << several.err;
  EXPECT_THAT(several.err, HasSubstr("found several scenes with 2 ranks, expected one scene"));
  use(FAKE_PLUGIN);
  const Outcome paper = together(fmt::format("run {} --ranks --out {}", path("scene.toml"), path("two")));
  EXPECT_EQ(paper.code, 1) << paper.err;
  EXPECT_THAT(paper.err, HasSubstr("it is made of paper"));
}

// Without --ranks, processes started by mpirun or srun are independent runs.
TEST_F(RanksProgram, RunsAloneUnlessItIsToldOtherwise) {
  write_scene();
  setenv("PMI_SIZE", "2", 1);
  const Outcome alone = run_quick("alone");
  const Outcome other = run_quick("other", "--ranks");
  unsetenv("PMI_SIZE");
  EXPECT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(other.code, 1) << other.err;
  EXPECT_THAT(
      other.err,
      HasSubstr("found 1 process, expected the 2 processes that mpirun started; use the mpirun of the MPI library"));
  const Outcome one = run_quick("one", "--ranks --backend cpu");
  EXPECT_EQ(one.code, 0) << one.err;
}

// The scene file differs between ranks, for example if one host has an old copy.
TEST_F(RanksProgram, RefusesDifferentScenes) {
  write_scene();
  const std::string text = read(folder_ / "scene.toml");
  std::ofstream(folder_ / "other.toml") << text << "# of another day\n";
  const Outcome two = together(fmt::format("run {0} --ranks --out {2} : -n 1 '{3}' run {1} --ranks --out {2}",
                                           path("scene.toml"), path("other.toml"), path("two"), MACADAM_PROGRAM));
  EXPECT_EQ(two.code, 1) << two.err;
  EXPECT_THAT(two.err, HasSubstr("ranks: checksum of "));
  EXPECT_THAT(two.err, HasSubstr("the ranks no longer run the same scene"));
}

TEST_F(RanksProgram, SaysWhatItNeeds) {
  write_scene();
  fs::remove(plugins_ / "libmacadam_ranks.so");
  fs::copy_file(folder_ / "t8.csv", plugins_ / "libmacadam_ranks.so");
  const Outcome two = together(fmt::format("run {} --ranks --out {}", path("scene.toml"), path("two")));
  EXPECT_EQ(two.code, 1) << two.err;
  EXPECT_THAT(two.err, HasSubstr("ranks: this process cannot join the other processes that mpirun started: "));
  setenv("MACADAM_PLUGIN_PATH", plugins_.c_str(), 1);
  EXPECT_THAT(macadam("info").out, HasSubstr("ranks      no: " + (plugins_ / "libmacadam_ranks.so").string()));
  unsetenv("MACADAM_PLUGIN_PATH");
  EXPECT_THAT(macadam("info").out, HasSubstr("ranks      yes: "));
}

}  // namespace
}  // namespace macadam::test
