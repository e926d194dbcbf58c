// SPDX-License-Identifier: GPL-3.0-or-later
// result_folder_test.cpp  The files in a results folder stay until an accepted command replaces them, and only one
// command at a time writes there.
#include "host/files/result_folder.hpp"

#include <signal.h>

#include <map>

#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

class Folder : public Program {
 protected:
  /// Returns every file of a folder with its bytes.
  std::map<std::string, std::string> content(const std::string& name) const {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name)) {
      if (entry.is_regular_file()) out[entry.path().string()] = read(entry.path());
    }
    return out;
  }
};

TEST_F(Folder, RefusedCommandsLeaveEveryFileAsItWas) {
  constexpr const char* contacts = "[output]\ncontacts = true\n";
  write_scene(quick, contacts);
  ASSERT_EQ(run_quick("out").code, 0);
  const auto before = content("out");
  ASSERT_EQ(before.size(), 4u);  // the files summary, response, contacts and specimen
  const auto expect_refused = [&](const std::string& arguments, const std::string& what) {
    const Outcome outcome = macadam(arguments);
    EXPECT_EQ(outcome.code, 2) << what << ": " << outcome.err;
    EXPECT_TRUE(content("out") == before) << what;
  };
  const std::string run = fmt::format("run {} --backend cpu --out {}", path("scene.toml"), path("out"));
  const std::string specimen = fmt::format("specimen {} --out {}", path("scene.toml"), path("out"));

  expect_refused(run + " --resume", "no checkpoint");
  expect_refused(specimen, "a specimen in the place of a run");
  EXPECT_HAS(macadam(specimen).err, "found a run (summary.json: status \"done\")");

  const std::string particles = read(folder_ / "t8.csv");
  write(folder_ / "t8.csv", particles + "175,0.001,0.001,0.001,-0.5,mastic,-1\n");
  for (const char* method : {"", "method = \"harmonic\"\n"}) {
    write_scene(std::string(quick) + method, contacts);
    expect_refused(run, "a bad particle");
  }
  write(folder_ / "t8.csv", particles);

  const std::string scene = read(write_scene(quick, contacts));
  std::string without = scene;
  without.replace(without.find("pair = \"A-A\""), 12, "pair = \"inner\"");
  write(folder_ / "scene.toml", without);
  expect_refused(run, "no law");
  write_scene(quick, "[network]\ngap_max = -1.0\n");
  expect_refused(run, "no path of contacts");
  write_scene("method = \"harmonic\"\n", "[network]\ngap_max = -0.2\n");  // some particles have no contacts
  expect_refused(run, "no harmonic solution");
}

// At 1e-20 Hz the dashpots are so soft compared with the springs that the stiffness matrix is singular to rounding. The
// run fails there, and keeps the results of the frequencies before.
TEST_F(Folder, SolutionsBeforeOneThatFailsStay) {
  write_scene_of("kind = \"cyclic\"\nfrequencies = [20, 5, 1e-20, 2]\n",
                 "method = \"harmonic\"\nlinear = \"iterative\"\n");
  const Outcome run = run_quick("out");
  EXPECT_EQ(run.code, 1);
  EXPECT_HAS(run.err, "at 1e-20 Hz");
  const auto found = summary("out").at("results");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found.at(0).at("frequency_hz"), 20);
  EXPECT_EQ(found.at(1).at("frequency_hz"), 5);
}

TEST_F(Folder, ARefusedCommandLeavesNoFolder) {
  write_scene(quick, "[network]\ngap_max = -1.0\n");
  for (const char* out : {"new/below", "new/below/", "./new/../new/x", "new/./x/."}) {
    EXPECT_EQ(macadam(fmt::format("run {} --out {}", path("scene.toml"), path(out))).code, 2) << out;
    EXPECT_FALSE(fs::exists(folder_ / "new")) << out;
  }
}

/// `macadam specimen` may overwrite the results of an earlier specimen, but not the results of a run or files of
/// another program.
TEST_F(Folder, ASpecimenMayReplaceASpecimenOnly) {
  write_scene();
  const std::string specimen = fmt::format("specimen {} --out {}", path("scene.toml"), path("out"));
  EXPECT_EQ(macadam(specimen).code, 0);
  EXPECT_EQ(macadam(specimen).code, 0);
  write(folder_ / "out/checkpoint.h5", "of a run");
  EXPECT_EQ(macadam(specimen).code, 2);
  fs::remove(folder_ / "out/checkpoint.h5");
  for (const char* other : {"", "{", "[]", "{\"name\": \"of another program\"}"}) {
    write(folder_ / "out/summary.json", other);
    EXPECT_EQ(macadam(specimen).code, 2) << other;
    EXPECT_EQ(read(folder_ / "out/summary.json"), other);
  }
}

/// A second command in the same folder is refused. The lock ends with its process, even after SIGKILL.
TEST_F(Folder, OneCommandAtATimeAndTheLockDiesWithIt) {
  const fs::path out = folder_ / "out";
  std::fflush(stdout);  // otherwise the child would print buffered text again
  const pid_t child = fork();
  if (child == 0) {
    for (;;) {
      try {
        const ResultFolder held(out);
        for (;;) pause();
      } catch (const Error&) {
        // The parent checks whether the folder is locked. During this check the parent itself may hold the lock, so the
        // child tries again. The parent also removes the folder if it is empty.
        usleep(500);
      }
    }
  }
  const auto held = [&] { return message_of([&] { const ResultFolder second(out); }); };
  while (held() == "nothing was thrown") usleep(1000);
  EXPECT_HAS(held(), out.string() + ": folder of the results: found another command that is writing into it");
  write_scene();
  for (const char* command : {"run", "specimen"}) {
    const Outcome second = macadam(fmt::format("{} {} --out {}", command, path("scene.toml"), path("out")));
    EXPECT_EQ(second.code, 2) << command;
    EXPECT_HAS(second.err, "another command");
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(run_quick("out").code, 0);
}

}  // namespace
}  // namespace macadam::test
