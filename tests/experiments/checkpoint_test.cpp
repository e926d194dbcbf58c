// SPDX-License-Identifier: GPL-3.0-or-later
// checkpoint_test.cpp  A run that is interrupted and resumed gives the same bits as an uninterrupted run. A run does
// not resume from the checkpoint of another run.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <H5Cpp.h>
#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <thread>

#include "host/files/checkpoint_file.hpp"
#include "tests/support/test_folder.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

constexpr const char* steady = "frequencies = [10.0, 20.0]\nstart = \"steady\"\nsamples_per_cycle = 40\n";
constexpr const char* rest = "frequencies = [20.0]\ncycles = 3\nramp_cycles = 1\nsamples_per_cycle = 40\n";

/// Limit of the size of a file [bytes]. The checkpoint of a run is larger than this limit; all its other files are
/// smaller.
constexpr rlim_t enough_for_the_rest = 40'000;

class CheckpointedRun : public TestFolder {
 protected:
  Scene scene(const std::string& loading, const std::string& solver = "density_scaling = 1e5\n",
              const std::string& output = "") const {
    return read_scene(write_t8("kind = \"cyclic\"\n" + loading, "backend = \"cpu\"\n" + solver, output));
  }
  fs::path file(const std::string& name) const { return out(name) / "checkpoint.h5"; }

  /// Runs the scene as TestFolder::run_until() does. If the run was interrupted, checks that its summary has the status
  /// "interrupted".
  bool run_until(const Scene& scene, const std::string& name, int asked, bool resume) const {
    const bool interrupted = TestFolder::run_until(scene, name, asked, resume);
    if (interrupted) { EXPECT_EQ(summary(name).at("status"), "interrupted"); }
    return interrupted;
  }
  nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(read(out(name) / "summary.json"));
  }
  /// Returns the summary without the wall-clock times.
  nlohmann::json timeless(const std::string& name) const {
    nlohmann::json all = summary(name);
    all.erase("timing_s");
    for (auto& result : all.at("results")) result.erase("solve_s");
    return all;
  }
  void expect_same(const std::string& name, const std::string& expected) const {
    EXPECT_EQ(timeless(name), timeless(expected));
    EXPECT_EQ(summary(name).at("status"), "done");
    const bool response = fs::exists(out(expected) / "response.csv");
    ASSERT_EQ(fs::exists(out(name) / "response.csv"), response);
    if (response) { EXPECT_TRUE(read(out(name) / "response.csv") == read(out(expected) / "response.csv")); }
    EXPECT_FALSE(fs::exists(file(name)));
    EXPECT_FALSE(fs::exists(out(name) / "checkpoint.h5.part"));
  }
  std::string refusal(const Scene& scene, const std::string& name) const {
    const std::string message = message_of([&] { run(scene, out(name), {}, true); });
    EXPECT_THROW(run(scene, out(name), {}, true), InputError);
    EXPECT_HAS(message, file(name).string());
    return message;
  }
};

/// Parameters: the lines of [loading], [solver] and [output] of a scene.
struct InPieces : CheckpointedRun, testing::WithParamInterface<std::tuple<const char*, const char*, const char*>> {
  static std::string name_of(const testing::TestParamInfo<ParamType>& info) {
    const auto& [loading, solver, output] = info.param;
    return fmt::format("{}_{}_{}", loading == steady ? "steady" : "rest",
                       std::strstr(solver, "mixed") ? "mixed" : "double", *output ? "alone" : "with_response");
  }
};

/// The run is interrupted six times, each time at a different step, and resumed. Its files must equal the files of an
/// uninterrupted run.
TEST_P(InPieces, GivesTheBitsOfOne) {
  const auto [loading, solver, output] = GetParam();
  const Scene scene = this->scene(loading, solver, output);
  run(scene, out("one"));
  int interrupted = 0;
  for (const int asked : {1, 2, 30, 3, 21, 15, 1000000}) {
    interrupted += run_until(scene, "pieces", asked, interrupted > 0);
    // Damage to response.csv does no harm, because the next piece rewrites it.
    if (interrupted == 3 && *output == 0) write(out("pieces") / "response.csv", "frequency_hz,time_s\n1,2\n");
  }
  EXPECT_EQ(interrupted, 6);
  expect_same("pieces", "one");
}

// With a density scaling of 1e5 a sample takes about ten steps, with 1e4 about thirty, so that runs are also
// interrupted between samples.
constexpr const char* heavy = "density_scaling = 1e5\n";
const char* const lighter =
    long_tests ? "density_scaling = 1e4\nprecision = \"mixed\"\n" : "density_scaling = 1e5\nprecision = \"mixed\"\n";
INSTANTIATE_TEST_SUITE_P(CheckpointedRun, InPieces,
                         testing::Combine(testing::Values(steady, rest), testing::Values(heavy, lighter),
                                          testing::Values("", "response = false\n")),
                         InPieces::name_of);

// Checkpoints are written at time intervals. A copy of the folder that is made during the run equals the folder after a
// kill at that moment. The run can be resumed from this copy.
TEST_F(CheckpointedRun, KeepsCheckpointsByTheClock) {
  const Scene scene = this->scene(steady, "density_scaling = 1e4\n", "checkpoint = \"1 ms\"\n");
  int copies = 0;
  Watcher watcher;
  watcher.progress = [&](const std::string& stage, double share) {
    if (stage.find("2 of 2") == std::string::npos || share < 0.5 || copies > 0 || !fs::exists(file("one"))) return;
    ++copies;
    fs::copy(out("one"), out("killed"), fs::copy_options::recursive);
  };
  run(scene, out("one"), watcher);
  ASSERT_EQ(copies, 1);
  write(out("killed") / "checkpoint.h5.part", "of a kill in the middle of the next");
  EXPECT_EQ(summary("killed").at("status"), "running");
  run(scene, out("killed"), {}, true);
  fs::remove(out("killed") / "checkpoint.h5.part");
  expect_same("killed", "one");

  const Scene seldom = this->scene(steady, "density_scaling = 1e5\n", "checkpoint = 0\n");
  watcher.progress = [&](const std::string&, double) { EXPECT_FALSE(fs::exists(file("none"))); };
  run(seldom, out("none"), watcher);
}

/// If the scene differs from the checkpoint in anything, or the checkpoint is missing, the run is refused. The message
/// names the difference, and the files stay unchanged.
TEST_F(CheckpointedRun, AnythingElseIsRefusedAndNamed) {
  const Scene scene = this->scene(steady);
  EXPECT_HAS(refusal(scene, "nowhere"), "no such file");
  ASSERT_TRUE(run_until(scene, "out", 20, false));
  const std::string kept = read(file("out")), response = read(out("out") / "response.csv");

  Scene other = this->scene(std::string(steady) + "strain_amplitude = 2e-4\n");
  EXPECT_HAS(refusal(other, "out"), "another scene: found line 9: [solver], expected line 9: strain_amplitude = 2e-4");
  other = scene;
  other.solver.precision = Precision::single;
  EXPECT_HAS(refusal(other, "out"), "another precision: found not given, expected single");
  other = scene;
  other.solver.form = ContactForm::points;
  EXPECT_HAS(refusal(other, "out"), "another form: found not given, expected points");
  other = scene;
  other.solver.backend = Backend::reference;
  EXPECT_HAS(message_of([&] { run(other, out("out"), {}, true); }), "backend reference keeps no checkpoints");
  other = scene;
  other.solver.method = SolverMethod::harmonic;
  EXPECT_HAS(message_of([&] { run(other, out("out"), {}, true); }), "method harmonic keeps no checkpoints");
  other = scene;
  other.text.clear();
  EXPECT_HAS(message_of([&] { run(other, out("out"), {}, true); }), "not read from a file");

  const auto changed = [&](const std::string& text, const std::string& value) {
    write(file("out"), kept);
    Checkpoint checkpoint = read_checkpoint(file("out"));
    EXPECT_EQ(checkpoint.texts.count(text), 1u);
    checkpoint.texts[text] = value;
    write_checkpoint(file("out"), checkpoint);
    return refusal(scene, "out");
  };
  EXPECT_HAS(changed("version", "0.0.7"), std::string("another version: found 0.0.7, expected ") + version());
  EXPECT_HAS(changed("backend", "cuda"), "another backend: found cuda, expected cpu");
  EXPECT_HAS(changed("plan", "{\"seconds\": "), "checkpoint: found ");
  EXPECT_HAS(changed("plan", "[]"), "checkpoint: found ");

  write(file("out"), kept);
  const std::string before = read(folder_ / "t8.csv");
  std::string particles = before;
  const auto digit = before.find(",mastic") - 1;
  particles[digit] = particles[digit] == '1' ? '2' : '1';  // the last digit of a radius
  write(folder_ / "t8.csv", particles);
  EXPECT_HAS(refusal(scene, "out"), "another specimen: found 175 particles");
  write(folder_ / "t8.csv", before);

  EXPECT_TRUE(read(file("out")) == kept);
  run(scene, out("out"), {}, true);  // the refused attempts have done no harm
  run(scene, out("one"));
  expect_same("out", "one");
}

/// Truncated, extended or bit-flipped checkpoints are refused.
TEST_F(CheckpointedRun, DamagedFilesAreRefused) {
  const Scene scene = this->scene(rest);
  ASSERT_TRUE(run_until(scene, "out", 20, false));
  const std::string kept = read(file("out"));
  ASSERT_GT(kept.size(), 10000u);
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{100}, std::size_t{512}, std::size_t{700},
                                   kept.size() / 2, kept.size() - 1}) {
    write(file("out"), kept.substr(0, length));
    EXPECT_HAS(refusal(scene, "out"), length < 100 ? "another kind of file" : "cut off or damaged");
  }
  write(file("out"), kept + "x");
  EXPECT_HAS(refusal(scene, "out"), "cut off or damaged");
  write(file("out"), "frequency_hz,time_s\n");
  EXPECT_HAS(refusal(scene, "out"), "another kind of file");
  std::mt19937 random(7);
  for (int k = 0; k < 50; ++k) {
    std::string damaged = kept;
    const std::size_t at = 512 + random() % (kept.size() - 512);
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
    write(file("out"), damaged);
    EXPECT_HAS(message_of([&] { read_checkpoint(file("out")); }), "damaged");
  }
  // The checksum is right, but the file contains no checkpoint.
  write(file("out"), kept);
  write_checkpoint(file("out"), {});
  EXPECT_HAS(refusal(scene, "out"), "checkpoint of another");
}

/// If the newest checkpoint is damaged or missing, the run resumes from the previous one, with a warning.
TEST_F(CheckpointedRun, WhereTheNewestIsDamagedTheOneBeforeIsGoneOnWith) {
  const Scene scene = this->scene(rest);
  const fs::path previous = out("out") / "checkpoint-previous.h5";
  run(scene, out("one"));
  const std::vector<std::function<void()>> damages = {[&] { write(file("out"), "nonsense"); },
                                                      [&] { fs::remove(file("out")); }};
  for (const auto& damage : damages) {
    ASSERT_TRUE(run_until(scene, "out", 20, false));
    EXPECT_FALSE(fs::exists(previous));
    const std::string first = read(file("out"));
    ASSERT_TRUE(run_until(scene, "out", 20, true));
    ASSERT_TRUE(read(previous) == first);
    damage();
    std::vector<std::string> warnings;
    Watcher watcher;
    watcher.warn = [&](const std::string& warning) { warnings.push_back(warning); };
    const RunResult result = run(scene, out("out"), watcher, true);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_HAS(warnings[0],
               "previous checkpoint, because the newest one is missing or damaged: " + file("out").string());
    EXPECT_EQ(result.warnings, warnings);
    EXPECT_TRUE(read(out("out") / "response.csv") == read(out("one") / "response.csv"));
    for (const fs::path& gone : {file("out"), previous}) EXPECT_FALSE(fs::exists(gone)) << gone;
  }
  // If both checkpoints are damaged, the message names the newest.
  ASSERT_TRUE(run_until(scene, "out", 20, false));
  write(file("out"), "nonsense");
  write(previous, "nonsense");
  EXPECT_HAS(refusal(scene, "out"), "checkpoint.h5: checkpoint: found another kind of file");
}

/// A correct checksum does not make the content of an HDF5 file valid. A checkpoint with wrong counts, or with links to
/// other files, is refused.
TEST_F(CheckpointedRun, ForgedCountsAndLinksAreRefused) {
  const auto refused = [&](const std::function<void(const H5::Group&, const H5::Group&)>& forge, const char* word) {
    const fs::path file = folder_ / "forged.h5";
    {
      const H5::H5File made(file.string(), H5F_ACC_TRUNC);
      const H5::Group texts = made.createGroup("texts"), arrays = made.createGroup("arrays");
      forge(texts, arrays);
    }
    const std::string image = read(file);
    write(file, user_block_of(image) + image);
    EXPECT_HAS(message_of([&] { read_checkpoint(file); }), word);
  };
  const hsize_t many = hsize_t{1} << 40;
  refused([&](auto&, auto& arrays) { arrays.createDataSet("x", H5::PredType::NATIVE_DOUBLE, H5::DataSpace(1, &many)); },
          "\"x\" is larger than the file");
  refused([&](auto& texts,
              auto&) { texts.createDataSet("t", H5::StrType(H5::PredType::C_S1, many >> 9), H5::DataSpace()); },
          "\"t\" is larger than the file");
  refused([&](auto& texts, auto&) { texts.createDataSet("t", H5::PredType::NATIVE_INT, H5::DataSpace()); },
          "\"t\" is of another type");
  refused([&](auto&, auto& arrays) { H5Lcreate_soft("/arrays", arrays.getId(), "x", H5P_DEFAULT, H5P_DEFAULT); },
          "\"x\" is not a dataset");
  refused([&](auto&, auto& arrays) { arrays.createGroup("x"); }, "\"x\" is not a dataset");
}

/// Writing is atomic: after a kill during writing the checkpoint is complete.
TEST_F(CheckpointedRun, AKillWhileWritingLeavesTheOldOrTheNewOne) {
  Checkpoint checkpoint;
  checkpoint.texts["text"] = "a\nb\n";
  checkpoint.arrays.push_back({"numbers", "m", std::vector<double>(100000, 0.1)});
  const fs::path file = folder_ / "checkpoint.h5";
  write_checkpoint(file, checkpoint);
  for (int k = 0; k < 20; ++k) {
    const pid_t child = fork();
    if (child == 0) {
      for (;;) write_checkpoint(file, checkpoint);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(3000 + 700 * k));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const Checkpoint found = read_checkpoint(file);
    EXPECT_EQ(found.texts, checkpoint.texts);
    EXPECT_TRUE(same_bits(found.arrays, checkpoint.arrays));
    EXPECT_EQ(found.arrays[0].unit, "m");
  }
  EXPECT_HAS(message_of([&] { write_checkpoint(folder_ / "no" / "checkpoint.h5", checkpoint); }), "cannot be written");
}

/// If the disk is full, a run gives a warning and goes on without writing checkpoints. It keeps the old checkpoint,
/// from which it can be resumed later.
TEST_F(CheckpointedRun, AFullDiskIsAWarningAndTheOldCheckpointStays) {
  const Scene scene = this->scene(steady);
  ASSERT_TRUE(run_until(scene, "out", 20, false));
  const std::string kept = read(file("out"));
  ASSERT_GT(kept.size(), 2 * enough_for_the_rest);
  const Scene often = this->scene(steady, "density_scaling = 1e4\n", "checkpoint = \"1 ms\"\n");
  {
    const FileLimit limit(enough_for_the_rest);
    EXPECT_HAS(message_of([&] {
                 write_checkpoint(file("out"), {{}, {{"n", "m", std::vector<double>(100000)}}});
               }),
               "checkpoint.h5: cannot be written");
    EXPECT_TRUE(read(file("out")) == kept);
    EXPECT_FALSE(fs::exists(out("out") / "checkpoint.h5.part"));

    int warned = 0;
    Watcher watcher;
    watcher.warn = [&](const std::string& warning) { warned += warning.find("the checkpoint at") == 0; };
    const RunResult result = run(often, out("limited"), watcher);
    EXPECT_GT(warned, 0);
    EXPECT_EQ(static_cast<int>(result.warnings.size()), warned);
    EXPECT_FALSE(fs::exists(out("limited") / "checkpoint.h5.part"));

    int asked = 0;
    bool planned = false;
    watcher.planned = [&](const RunResult&) { planned = true; };
    watcher.stop = [&] { return planned && ++asked > 20; };
    EXPECT_HAS(message_of([&] { run(scene, out("stopped"), watcher); }), "the run cannot be resumed");
    EXPECT_EQ(summary("stopped").at("status"), "interrupted");
    EXPECT_HAS(message_of([&] { run(scene, out("out"), watcher, true); }),
               "--resume continues from the previous checkpoint");
    EXPECT_EQ(summary("out").at("status"), "interrupted");
  }
  run(often, out("free"));
  EXPECT_TRUE(read(out("limited") / "response.csv") == read(out("free") / "response.csv"));
  run(scene, out("out"), {}, true);
  run(scene, out("one"));
  expect_same("out", "one");
}

/// Warnings are kept in the checkpoint, so that a resumed run reports them again.
TEST_F(CheckpointedRun, KeepsItsWarningsWhereItGoesOn) {
  const Scene often = scene(steady, "density_scaling = 1e4\n", "checkpoint = \"1 ms\"\n");
  std::optional<FileLimit> limit(std::in_place, enough_for_the_rest);
  std::vector<std::string> warned;
  Watcher watcher;
  watcher.warn = [&](const std::string& warning) { warned.push_back(warning), limit.reset(); };
  watcher.stop = [&] { return !warned.empty(); };
  EXPECT_THROW(run(often, out("out"), watcher), InterruptedError);
  ASSERT_EQ(warned.size(), 1u);
  EXPECT_HAS(warned[0], "the checkpoint at");
  EXPECT_EQ(run(often, out("out"), {}, true).warnings, warned);
}

/// A harmonic run in the same folder does not touch the checkpoint of a stepped run.
TEST_F(CheckpointedRun, ARunOfAnotherKindLeavesTheCheckpointAlone) {
  const Scene scene = this->scene(steady);
  ASSERT_TRUE(run_until(scene, "out", 20, false));
  const std::string kept = read(file("out"));
  Scene harmonic = scene;
  harmonic.solver.method = SolverMethod::harmonic;
  run(harmonic, out("out"));
  EXPECT_TRUE(read(file("out")) == kept);
  run(scene, out("out"), {}, true);
  run(scene, out("one"));
  expect_same("out", "one");
}

// A finished run removes the checkpoint of its own scene, because all results of the scene exist. It leaves the
// checkpoint of another scene.
TEST_F(CheckpointedRun, AFinishedRunRemovesItsOwnCheckpointOnly) {
  const Scene scene = this->scene(steady);
  ASSERT_TRUE(run_until(scene, "out", 20, false));
  const std::string kept = read(file("out"));
  run(scene, out("out"));
  EXPECT_FALSE(fs::exists(file("out")));
  write(file("out"), kept);
  run(this->scene(std::string(steady) + "strain_amplitude = 2e-4\n"), out("out"));
  EXPECT_TRUE(read(file("out")) == kept);
}

// A device that steps in another way stores other state arrays in its checkpoint. The test imitates this by renaming
// one array. Such a checkpoint is refused before any result file changes.
TEST_F(CheckpointedRun, AnotherMachinesCheckpointIsRefusedBeforeAnythingIsTouched) {
  const Scene scene = this->scene(steady);
  run(scene, out("out"));
  ASSERT_TRUE(run_until(scene, "other", 20, false));
  Checkpoint checkpoint = read_checkpoint(file("other"));
  for (StateArray& array : checkpoint.arrays) {
    if (array.name == "state sums") array.name = "state loads";
  }
  write_checkpoint(file("out"), checkpoint);
  const std::string response = read(out("out") / "response.csv"), all = read(out("out") / "summary.json");
  EXPECT_HAS(refusal(scene, "out"), "this machine cannot continue the checkpoint");
  EXPECT_TRUE(read(out("out") / "response.csv") == response);
  EXPECT_TRUE(read(out("out") / "summary.json") == all);
}

// In a checkpoint, the HDF5 data start after a user block, so their base address is not 0. HDF5's own library must
// still read the file.
TEST_F(CheckpointedRun, IsAnHdf5FileForAnyReader) {
  write_checkpoint(folder_ / "checkpoint.h5", {{{"text", "words"}}, {{"numbers", "m", std::vector<double>{1, 2}}}});
  const H5::H5File in((folder_ / "checkpoint.h5").string(), H5F_ACC_RDONLY);
  double values[2];
  in.openDataSet("arrays/numbers").read(values, H5::PredType::NATIVE_DOUBLE);
  EXPECT_EQ(values[1], 2);
}

/// The key `checkpoint` in the scene sets the time between checkpoints. The reference backend cannot write checkpoints,
/// so it refuses the key.
TEST_F(CheckpointedRun, SceneSaysHowOftenAndTheReferenceRefuses) {
  EXPECT_FALSE(scene(rest).output.checkpoint);
  EXPECT_EQ(scene(rest, "", "checkpoint = \"10 min\"\n").output.checkpoint, 600.0);
  EXPECT_EQ(scene(rest, "", "checkpoint = \"1.5 h\"\n").output.checkpoint, 5400.0);
  EXPECT_EQ(scene(rest, "", "checkpoint = 0\n").output.checkpoint, 0.0);
  EXPECT_THROW(scene(rest, "", "checkpoint = -1\n"), InputError);
  Scene asked = scene(rest, "", "checkpoint = \"1 min\"\n");
  asked.solver.backend = Backend::reference;
  EXPECT_HAS(message_of([&] { run(asked, out("out")); }), "reference keeps no checkpoints");
  EXPECT_FALSE(fs::exists(out("out")));  // refused before the folder is made
}

// Runs the program and interrupts it with SIGTERM (as a queueing system does) and SIGINT (as a terminal does). The
// program must leave a checkpoint from which it can resume.
TEST_F(CheckpointedRun, SignalsLeaveACheckpointThatTheProgramResumes) {
  scene(rest, long_tests ? "density_scaling = 3e2\nthreads = 1\n" : "density_scaling = 3e3\nthreads = 1\n");
  const auto start = [&](const std::string& name, bool resume) {
    const pid_t child = fork();
    if (child == 0) {
      const std::string to = out(name).string(), scene = (folder_ / "scene.toml").string();
      // The shell that runs the tests may ignore these signals, and its children would inherit that.
      for (const int number : {SIGINT, SIGTERM}) signal(number, SIG_DFL);
      if (!freopen((folder_ / "stdout.txt").c_str(), "w", stdout)) _exit(99);
      if (!freopen((folder_ / "stderr.txt").c_str(), "w", stderr)) _exit(99);
      execl(MACADAM_PROGRAM, MACADAM_PROGRAM, "run", scene.c_str(), "--out", to.c_str(), resume ? "--resume" : nullptr,
            nullptr);
      _exit(99);
    }
    return child;
  };
  const auto end_of = [](pid_t child) {
    int status = -1;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  const auto size_of = [&](const std::string& name) {
    std::error_code error;
    const auto size = fs::file_size(out(name) / "response.csv", error);
    return error ? std::uintmax_t{0} : size;
  };
  ASSERT_EQ(end_of(start("one", false)), 0) << read(folder_ / "stderr.txt");
  const std::uintmax_t whole = size_of("one");
  bool resume = false;
  for (const int signal : {SIGTERM, SIGINT}) {
    const std::uintmax_t wanted =
        size_of("out") + whole / 6;  // bytes; this is more than a resumed run rewrites before its first step
    const pid_t child = start("out", resume);
    while (size_of("out") < wanted && waitpid(child, nullptr, WNOHANG) == 0) usleep(1000);
    ASSERT_EQ(kill(child, signal), 0) << "it was done before it could be interrupted";
    ASSERT_EQ(end_of(child), 1) << read(folder_ / "stderr.txt");
    EXPECT_HAS(read(folder_ / "stderr.txt"), "--resume");
    EXPECT_EQ(summary("out").at("status"), "interrupted");
    EXPECT_TRUE(fs::exists(file("out")));
    EXPECT_LT(size_of("out"), whole);
    resume = true;
  }
  const fs::path copy = out("copy");
  fs::copy(out("out"), copy);
  ASSERT_EQ(end_of(start("copy", false)), 0);
  EXPECT_HAS(read(folder_ / "stderr.txt"),
             "an earlier run left this checkpoint; the run now starts from the beginning, and --resume would have "
             "continued the earlier run");
  EXPECT_FALSE(fs::exists(file("copy")));
  ASSERT_EQ(end_of(start("out", true)), 0) << read(folder_ / "stderr.txt");
  EXPECT_EQ(read(folder_ / "stderr.txt").find("starts from the beginning"), std::string::npos);
  expect_same("out", "one");
  EXPECT_EQ(end_of(start("out", true)), 2);
  EXPECT_HAS(read(folder_ / "stderr.txt"), "no such file");
}

}  // namespace
}  // namespace macadam::test
