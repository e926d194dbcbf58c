// SPDX-License-Identifier: GPL-3.0-or-later
// stop_signals_test.cpp  Signals at any time, once or several at once: a checkpoint, or an untouched folder.
#include <signal.h>

#include "host/cli/stop_signals.hpp"
#include "program.hpp"

namespace macadam::test {
namespace {

class StopSignals : public Program {
 protected:
  /// Starts `macadam arguments…`.
  pid_t start(std::vector<std::string> arguments) const {
    std::fflush(stdout);  // or the child would write it again
    const pid_t child = fork();
    if (child != 0) return child;
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) signal(number, SIG_DFL);  // who runs tests may ignore them
    if (!freopen((folder_ / "stdout.txt").c_str(), "w", stdout)) _exit(99);
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
  /// Waits until the program catches SIGTERM: a larger one takes its time to be loaded.
  static void wait_until_it_listens(pid_t child) {
    while (waitpid(child, nullptr, WNOHANG) == 0) {
      std::ifstream status("/proc/" + std::to_string(child) + "/status");
      for (std::string line; std::getline(status, line);) {
        if (line.starts_with("SigCgt:") && (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1)) return;
      }
      usleep(1000);
    }
  }
  static int end_of(pid_t child) {
    int status = -1;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
};

// coreutils' timeout sends one to its child and another to the child's group, at once.
TEST_F(StopSignals, SeveralAtOnceAreOne) {
  write_scene("density_scaling = 1e3\n");
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

TEST_F(StopSignals, StopACommandOfSeveralScenes) {
  const fs::path scene = write_scene("density_scaling = 1e3\n");
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

// The functions themselves, in a process that has nothing to end for.
TEST(StopSignal, AfterTwoSecondsItEndsTheProgram) {
  std::fflush(stdout);
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGTERM, SIG_DFL);
    listen_to_stop_signals();
    if (::write(ready[1], "", 1) != 1) _exit(99);
    for (;;) pause();
  }
  char byte;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  kill(child, SIGTERM);
  usleep(1'500'000);
  kill(child, SIGTERM);
  usleep(100'000);
  EXPECT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "within two seconds it is the same signal";
  usleep(500'000);
  kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  close(ready[0]);
  close(ready[1]);
}

// Making the preconditioner asks for no signals: what came meanwhile counts before any file is touched.
TEST_F(StopSignals, DuringTheHarmonicPlanTheFolderStaysAsItWas) {
  write_scene();
  ASSERT_EQ(run_quick("out").code, 0);
  const std::string before = read(folder_ / "out/summary.json");
  fs::remove(folder_ / "stdout.txt");  // which has the first run's words
  const pid_t child =
      start({"run", MACADAM_EXAMPLES "/demo/scene.toml", "--method", "harmonic", "--out", (folder_ / "out").string()});
  const auto prepared = [&] {
    std::ifstream in(folder_ / "stdout.txt");
    return std::string(std::istreambuf_iterator<char>(in), {}).find("specimen ") != std::string::npos;
  };
  while (waitpid(child, nullptr, WNOHANG) == 0 && !prepared()) usleep(1000);
  kill(child, SIGTERM);
  EXPECT_EQ(end_of(child), 1);
  EXPECT_HAS(read(folder_ / "stderr.txt"), "nothing was written");
  EXPECT_EQ(read(folder_ / "out/summary.json"), before);
  EXPECT_TRUE(fs::exists(folder_ / "out/response.csv"));
}

// Generating the demo's specimen takes a second; nothing of the folder is touched before.
TEST_F(StopSignals, BeforeTheFirstStepTheyLeaveTheFolderAsItWas) {
  write_scene();
  ASSERT_EQ(run_quick("out").code, 0);
  const std::string before = read(folder_ / "out/summary.json");
  for (const char* command : {"run", "specimen"}) {
    const std::string out = *command == 'r' ? "out" : "new";
    const pid_t child = start({command, MACADAM_EXAMPLES "/demo/scene.toml", "--out", (folder_ / out).string()});
    while (*command == 's' && !fs::exists(folder_ / out) && waitpid(child, nullptr, WNOHANG) == 0) usleep(1000);
    wait_until_it_listens(child);
    usleep(100'000);
    kill(child, SIGTERM);
    usleep(5000);
    kill(child, SIGTERM);
    EXPECT_EQ(end_of(child), 1) << command;
    EXPECT_HAS(read(folder_ / "stderr.txt"), "nothing was written");
  }
  EXPECT_EQ(read(folder_ / "out/summary.json"), before);
  EXPECT_TRUE(fs::exists(folder_ / "out/response.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

}  // namespace
}  // namespace macadam::test
