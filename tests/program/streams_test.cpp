// SPDX-License-Identifier: GPL-3.0-or-later
// streams_test.cpp  Runs the program with standard input, output and error that are closed, full, not read, limited in
// size, or a terminal that has closed.
#include <pty.h>
#include <signal.h>

#include "host/cli/terminal/progress_line.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

class Streams : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write_scene();
  }

  /// Runs a command in bash, where $M is the program; returns the exit code and the standard error.
  Outcome shell(const std::string& command) const {
    write(folder_ / "command.sh", "M='" MACADAM_PROGRAM "'\ncd '" + folder_.string() + "'\n" + command + "\n");
    const fs::path err = folder_ / "stderr.txt";
    write(err, "");
    const int status =
        std::system(fmt::format("bash '{}' 2>'{}'", (folder_ / "command.sh").string(), err.string()).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", read(err)};
  }
};

// For commands whose only result is their output, lost output is an error.
TEST_F(Streams, LostOutputOfACommandThatOnlyPrintsIsExitCodeOne) {
  const std::string surface = "'" MACADAM_EXAMPLES "/icosahedron/icosahedron.off'";
  for (const std::string& command :
       std::vector<std::string>{"info", "--help", "run --help", "--version", "shapes check " + surface,
                                "shapes measure " + surface + " --out measured"}) {
    ASSERT_EQ(shell("$M " + command + " > said.txt").code, 0) << command;
    for (const char* lost : {">/dev/full", ">&-", "| false; exit ${PIPESTATUS[0]}"}) {
      const Outcome outcome = shell("$M " + std::string(command) + " " + lost);
      // The pipe may hold all output before its reader ends.
      if (*lost == '|' && outcome.code == 0) continue;
      EXPECT_EQ(outcome.code, 1) << command << " " << lost;
      EXPECT_HAS(outcome.err, "standard output: cannot be written");
    }
    EXPECT_EQ(shell("$M " + command + " >/dev/full 2>/dev/full").code, 1) << command;
    EXPECT_EQ(shell("$M " + command + " >&- 2>&-").code, 1) << command;
  }
}

// The results of a run are in its files, so a run succeeds even if its streams are closed. No file may get output that
// was meant for a stream.
TEST_F(Streams, ARunNeedsNone) {
  ASSERT_EQ(run_quick("out").code, 0);
  for (const char* streams : {">/dev/full", "| head -n 1 >/dev/null; exit ${PIPESTATUS[0]}", ">&-", "2>&-", "<&-",
                              "<&- >&- 2>&-", ">/dev/full 2>/dev/full"}) {
    fs::remove_all(folder_ / "other");
    EXPECT_EQ(shell("$M run scene.toml --backend cpu --out other " + std::string(streams)).code, 0) << streams;
    for (const char* name : {"specimen.csv", "response.csv"}) {
      EXPECT_TRUE(read(folder_ / "other" / name) == read(folder_ / "out" / name)) << streams << ": " << name;
    }
    EXPECT_EQ(summary("other").at("status"), "done") << streams;
  }
}

TEST_F(Streams, AnErrorKeepsItsExitCodeWhereNobodyHearsIt) {
  for (const char* streams : {"2>&-", "2>/dev/full", ">&- 2>&-", ">/dev/full 2>/dev/full"}) {
    EXPECT_EQ(shell("$M run nowhere.toml --out out " + std::string(streams)).code, 2) << streams;
    EXPECT_EQ(shell("$M runn " + std::string(streams)).code, 2) << streams;
  }
}

// `ulimit -f` counts blocks of 1,024 bytes; specimen.csv has about 14,000 bytes.
TEST_F(Streams, AFileBeyondItsLimitIsAnErrorAndLeavesNoPart) {
  const Outcome outcome = shell("ulimit -f 4; $M run scene.toml --backend cpu --out out");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_HAS(outcome.err, "specimen.csv: cannot be written");
  EXPECT_FALSE(fs::exists(folder_ / "out/specimen.csv.part"));
}

TEST_F(Streams, ANewSceneBeyondItsLimitIsAnErrorAndLeavesNoPart) {
  const Outcome outcome = shell("ulimit -f 1; timeout -k 5 3600 $M new other.toml");
  EXPECT_EQ(outcome.code, 1) << "124: it tries for ever";
  EXPECT_HAS(outcome.err, "other.toml: cannot be written");
  EXPECT_FALSE(fs::exists(folder_ / "other.toml"));
}

// If OpenBLAS cannot allocate its buffers, it retries forever. The program must end with an error; its libraries are
// already loaded at that point.
TEST_F(Streams, TooLittleMemoryEndsARun) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer takes terabytes of addresses";
#endif
  write_scene("method = \"harmonic\"\nlinear = \"direct\"\n");
  // `seconds` limits the processor time, which does not grow on a busy machine. The
  // limit of the wall time only ends a program that waits for ever.
  const auto limited = [&](int megabytes, int seconds, const char* command) {
    return shell(fmt::format(
        "unset OPENBLAS_NUM_THREADS; export OMP_NUM_THREADS=1; ulimit -v {}; ulimit -t {}; timeout -k 5 3600 $M {}",
        megabytes * 1024, seconds, command));
  };
  // With less memory the libraries cannot even be loaded; OpenBLAS 0.3.29 then hangs before the program begins.
  int too_little = 60, least = 500;
  while (least - too_little > 4) {
    const int middle = (too_little + least) / 2;
    (limited(middle, 5, "--version >/dev/null").code == 0 ? least : too_little) = middle;
  }
  EXPECT_LT(least, 300);
  int refused = 0, done = 0;
  for (int megabytes = least; megabytes <= least + 300; megabytes += 25) {
    const Outcome outcome = limited(megabytes, 20, "run scene.toml --out out");
    ASSERT_NE(outcome.code, 124) << megabytes << " MB: it hangs";
    ASSERT_NE(outcome.code, 137) << megabytes << " MB: it hangs";
    ASSERT_NE(outcome.code, 128 + SIGXCPU) << megabytes << " MB: it takes the processor for ever";
    refused += contains(outcome.err, "macadam: out of memory");
    done += outcome.code == 0;
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(done, 0);
}

// If a tenth of the work took at least 0.3 s, the time that is left is at least 2.7 s, however slow the machine is. At
// the end of the work no time is left.
TEST(ProgressLine, SaysTheTimeThatIsLeft) {
  std::fflush(stdout);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(child, 0);
  if (child == 0) {
    ProgressLine line;
    line.show("stage", 0);
    for (const double share : {0.1, 1.0}) {
      usleep(300'000);
      line.show("stage", share);
    }
    _exit(0);
  }
  std::string shown;
  char piece[256];
  for (ssize_t n = 0; (n = ::read(terminal, piece, sizeof piece)) > 0;)
    shown.append(piece, static_cast<std::size_t>(n));
  close(terminal);
  waitpid(child, nullptr, 0);
  const std::size_t at = shown.find("stage 10 %, ");
  ASSERT_NE(at, std::string::npos) << shown;
  EXPECT_GE(std::atoi(shown.c_str() + at + 12), 3) << shown;
  EXPECT_HAS(shown, "stage 100 %, 0 s left");
}

// After nohup or `disown -h`, the progress line writes to a terminal that returns EIO.
TEST_F(Streams, ATerminalThatIsGoneDoesNotEndARun) {
  write_scene("density_scaling = 3e3\n");
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(child, 0);
  if (child == 0) {
    signal(SIGHUP, SIG_IGN);
    execl(MACADAM_PROGRAM, MACADAM_PROGRAM, "run", (folder_ / "scene.toml").c_str(), "--backend", "cpu", "--out",
          (folder_ / "out").c_str(), nullptr);
    _exit(99);
  }
  std::string shown;
  char piece[256];
  for (ssize_t n = 0; shown.find(" left") == std::string::npos && (n = ::read(terminal, piece, sizeof piece)) > 0;) {
    shown.append(piece, static_cast<std::size_t>(n));
  }
  EXPECT_HAS(shown, " left");  // the run was in progress
  close(terminal);
  int status = -1;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status)) << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(summary("out").at("status"), "done");
}

}  // namespace
}  // namespace macadam::test
