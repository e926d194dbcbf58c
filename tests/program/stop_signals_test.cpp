// SPDX-License-Identifier: GPL-3.0-or-later
// stop_signals_test.cpp  Tests stop signals at any time, a single signal or several at once: either the program leaves
// a checkpoint, or the folder is unchanged.
#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>

#include "host/cli/terminal/fault_signals.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

/// Solver settings of a run that takes minutes, so that a signal comes before its end even on a busy machine.
constexpr const char* minutes_long = "density_scaling = 1.0\n";

/// A full pipe: whoever writes into it waits until somebody reads.
class FullPipe {
 public:
  FullPipe() {
    if (pipe2(ends_, O_NONBLOCK) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
    while (::write(ends_[1], "", 1) == 1) {}
    fcntl(ends_[1], F_SETFL, 0);  // from now on a writer waits until the pipe has space
    fcntl(ends_[0], F_SETFL, 0);
  }
  FullPipe(const FullPipe&) = delete;
  ~FullPipe() {
    close(ends_[0]);
    if (ends_[1] >= 0) close(ends_[1]);
  }
  int to_write() const { return ends_[1]; }
  /// Reads until all writers have closed the pipe.
  void drain() {
    close(std::exchange(ends_[1], -1));
    char piece[4096];
    while (::read(ends_[0], piece, sizeof piece) > 0) {}
  }

 private:
  int ends_[2] = {-1, -1};
};

class StopSignals : public Program {
 protected:
  /// Starts `macadam arguments…` as a child. Its output goes to stdout.txt or into `output`.
  pid_t start(std::vector<std::string> arguments, int output = -1) const {
    std::fflush(stdout);  // otherwise the child would print buffered text again
    const pid_t child = fork();
    if (child != 0) return child;
    // The shell that runs the tests may ignore these signals, and its children would inherit that.
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) signal(number, SIG_DFL);
    if (output >= 0 ? dup2(output, STDOUT_FILENO) < 0 : !freopen((folder_ / "stdout.txt").c_str(), "w", stdout))
      _exit(99);
    if (!freopen((folder_ / "stderr.txt").c_str(), "w", stderr)) _exit(99);
    std::vector<char*> words;
    arguments.insert(arguments.begin(), MACADAM_PROGRAM);
    for (std::string& a : arguments) words.push_back(a.data());
    words.push_back(nullptr);
    execv(MACADAM_PROGRAM, words.data());
    _exit(99);
  }
  pid_t start_run(const std::string& out) const {
    return start({"run", (folder_ / "scene.toml").string(), "--backend", "cpu", "--threads", "1", "--out",
                  (folder_ / out).string()});
  }
  /// Waits until the program has written some samples.
  void wait_for_samples(pid_t child, const std::string& out) const {
    std::error_code error;
    while (waitpid(child, nullptr, WNOHANG) == 0) {
      const auto size = fs::file_size(folder_ / out / "response.csv", error);
      if (!error && size > 2000) return;
      usleep(1000);
    }
    FAIL() << "it ended too soon: " << read(folder_ / "stderr.txt");
  }
  /// Waits until the program has installed its handler of SIGTERM, because a large program takes time to load.
  static void wait_until_it_listens(pid_t child) {
    while (waitpid(child, nullptr, WNOHANG) == 0) {
      std::ifstream status("/proc/" + std::to_string(child) + "/status");
      for (std::string line; std::getline(status, line);) {
        if (line.starts_with("SigCgt:") && (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1)) return;
      }
      usleep(1000);
    }
  }
  /// Waits until the program blocks in writing to its standard output. Returns false if the system does not show system
  /// calls in /proc.
  static bool wait_until_it_waits_for_output(pid_t child) {
    while (waitpid(child, nullptr, WNOHANG) == 0) {
      std::ifstream file("/proc/" + std::to_string(child) + "/syscall");
      long number = -1;
      std::string descriptor;
      if (!file) return false;
      if (file >> number >> descriptor && number == SYS_write && descriptor == "0x1") return true;
      usleep(1000);
    }
    return false;
  }
  static int end_of(pid_t child) {
    int status = -1;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
};

// timeout of coreutils sends a signal to its child, and at once sends another one to the child's process group. The
// program must take several signals as one request to stop.
TEST_F(StopSignals, SeveralAtOnceAreOne) {
  write_scene(minutes_long);
  const std::vector<std::vector<int>> bursts{
      {SIGTERM, SIGTERM}, {SIGINT, SIGINT, SIGINT}, {SIGHUP}, {SIGHUP, SIGTERM}, {SIGTERM, SIGINT}};
  for (std::size_t k = 0; k < bursts.size(); ++k) {
    const std::string out = fmt::format("out{}", k);
    const pid_t child = start_run(out);
    wait_for_samples(child, out);
    for (const int number : bursts[k]) {
      kill(child, number);
      usleep(static_cast<unsigned>(2000 * k));
    }
    EXPECT_EQ(end_of(child), 1) << k;
    EXPECT_HAS(read(folder_ / "stderr.txt"), "--resume");
    EXPECT_EQ(summary(out).at("status"), "interrupted");
    EXPECT_TRUE(fs::exists(folder_ / out / "checkpoint.h5"));
  }
}

/// One signal stops all scenes of a command.
TEST_F(StopSignals, StopACommandOfSeveralScenes) {
  const fs::path scene = write_scene(minutes_long);
  std::vector<std::string> arguments{"run"};
  for (const char* name : {"first.toml", "second.toml"}) {
    fs::copy_file(scene, folder_ / name);
    arguments.push_back((folder_ / name).string());
  }
  for (const char* word : {"--backend", "cpu", "--threads", "1", "--at-once", "1", "--out"})
    arguments.emplace_back(word);
  arguments.push_back((folder_ / "out").string());
  const pid_t child = start(arguments);
  wait_for_samples(child, "out/first");
  kill(child, SIGTERM);
  EXPECT_EQ(end_of(child), 1);
  EXPECT_HAS(read(folder_ / "stderr.txt"), "interrupted: 2 of 2 scenes are not done");
  EXPECT_TRUE(fs::exists(folder_ / "out/first/checkpoint.h5"));
  EXPECT_FALSE(fs::exists(folder_ / "out/second/response.csv"));
}

// Tests the signal handler without a run: a child process raises the signal repeatedly until it dies. Only the lower
// limit of two seconds is checked, because on a slow machine the process dies later, but never earlier.
TEST(StopSignal, AfterTwoSecondsItEndsTheProgram) {
  std::fflush(stdout);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGTERM, SIG_DFL);
    listen_to_stop_signals();
    for (;;) {
      raise(SIGTERM);
      if (!stop_asked()) _exit(99);
      usleep(1000);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2)) << "within them it is the same signal";
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
}

// A full pipe stops the program when it prints its description of the specimen. The next step, making the
// preconditioner, does not check for signals; a signal that came in the meantime must be noticed before any file is
// changed.
TEST_F(StopSignals, BeforeTheHarmonicPlanTheFolderStaysAsItWas) {
  write_scene();
  ASSERT_EQ(run_quick("out").code, 0);
  const std::string before = read(folder_ / "out/summary.json");
  FullPipe output;
  const pid_t child =
      start({"run", MACADAM_EXAMPLES "/demo/scene.toml", "--method", "harmonic", "--out", (folder_ / "out").string()},
            output.to_write());
  const bool held = wait_until_it_waits_for_output(child);
  kill(child, held ? SIGTERM : SIGKILL);
  output.drain();
  const int code = end_of(child);
  if (!held) GTEST_SKIP() << "/proc does not show which system call a process waits in";
  EXPECT_EQ(code, 1);
  EXPECT_HAS(read(folder_ / "stderr.txt"), "nothing was written");
  EXPECT_EQ(read(folder_ / "out/summary.json"), before);
  EXPECT_TRUE(fs::exists(folder_ / "out/response.csv"));
}

// Generating this specimen takes longer than the test waits, so the test passes only if the signal stops the
// generation.
TEST_F(StopSignals, BeforeTheFirstStepTheyLeaveTheFolderAsItWas) {
  write_scene();
  ASSERT_EQ(run_quick("out").code, 0);
  const std::string before = read(folder_ / "out/summary.json");
  const std::string small_box = R"(["20 mm", "20 mm", "30 mm"])";
  std::string scene = read(MACADAM_EXAMPLES "/demo/scene.toml");
  ASSERT_TRUE(contains(scene, small_box));
  scene.replace(scene.find(small_box), small_box.size(), R"(["80 mm", "80 mm", "120 mm"])");
  const fs::path large = folder_ / "large.toml";
  write(large, scene);
  for (const char* command : {"run", "specimen"}) {
    const std::string out = *command == 'r' ? "out" : "new";
    const pid_t child = start({command, large.string(), "--out", (folder_ / out).string()});
    while (*command == 's' && !fs::exists(folder_ / out) && waitpid(child, nullptr, WNOHANG) == 0) usleep(1000);
    wait_until_it_listens(child);
    kill(child, SIGTERM);
    kill(child, SIGTERM);
    EXPECT_EQ(end_of(child), 1) << command;
    EXPECT_HAS(read(folder_ / "stderr.txt"), "nothing was written");
  }
  EXPECT_EQ(read(folder_ / "out/summary.json"), before);
  EXPECT_TRUE(fs::exists(folder_ / "out/response.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

// A fault of memory says that it ended the program, and the signal still does so.
TEST(FaultSignals, EndWithAWord) {
  for (const int number : {SIGSEGV, SIGBUS}) {
    const auto fault = [number] {
      signal(number, SIG_DFL);  // a sanitizer has a handler of its own
      report_fault_signals();
      raise(number);
    };
    EXPECT_EXIT(fault(), testing::KilledBySignal(number), "macadam: ended by a fault of memory");
  }
}

}  // namespace
}  // namespace macadam::test
