// SPDX-License-Identifier: GPL-3.0-or-later
/// \file test_folder.hpp  A temporary folder per test with the small specimen t8 in it, and a limit on file sizes that
/// acts like a full disk.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/support/test_files.hpp"

namespace macadam::test {

/// Makes a folder with the specimen t8 and removes it after the test.
class TestFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::path(testing::TempDir()) / "macadam_test_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr) << name;
    folder_ = name;
    fs::copy_file(MACADAM_TEST_DATA "/t8.csv", folder_ / "t8.csv");
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Writes a scene of the 175 particles of t8. The specimen's path is relative to the scene file.
  fs::path write_t8(const std::string& loading, const std::string& solver, const std::string& output = "") const {
    write(folder_ / "scene.toml", "[specimen]\nfile = \"t8.csv\"\nbox = [0.008, 0.008, 0.011]\n[loading]\n" + loading +
                                      "[solver]\n" + solver + (output.empty() ? "" : "[output]\n" + output) +
                                      am1_contacts);
    return folder_ / "scene.toml";
  }
  fs::path out(const std::string& name) const { return folder_ / name; }

  /// Runs the scene. Interrupts the run at its `asked`-th call of `stop` after planning; if `asked` is 0, the run
  /// continues to its end. Returns whether the run was interrupted.
  bool run_until(const Scene& scene, const std::string& name, int asked, bool resume = false) const {
    Watcher watcher;
    int count = 0;
    bool planned = false;
    watcher.planned = [&](const RunResult&) { planned = true; };
    watcher.stop = [&] { return planned && asked > 0 && ++count >= asked; };
    try {
      run(scene, out(name), watcher, resume);
      return false;
    } catch (const InterruptedError& error) {
      EXPECT_HAS(error.what(), "--resume");
      EXPECT_HAS(error.what(), (out(name) / "checkpoint.h5").string());
      EXPECT_TRUE(fs::exists(out(name) / "checkpoint.h5"));
      return true;
    }
  }

  fs::path folder_;
};

/// Limits the size of every file that this process writes, as long as the object exists: writing beyond `bytes` fails
/// as on a full disk.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) {
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

}  // namespace macadam::test
