// SPDX-License-Identifier: GPL-3.0-or-later
// plugin_test.cpp  The CUDA plugin is loaded at run time if it has the right version; otherwise the program states the
// reason.
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

class Plugin : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    setenv("MACADAM_PLUGIN_PATH", ("/none::" + folder_.string()).c_str(), 1);
  }
  void TearDown() override {
    unsetenv("MACADAM_PLUGIN_PATH");
    Program::TearDown();
  }

  /// Runs the program with `file` in place of the plugin.
  Outcome with(const fs::path& file, const std::string& command = "info") const {
    fs::remove(folder_ / "libmacadam_cuda.so");
    fs::copy_file(file, folder_ / "libmacadam_cuda.so");
    return macadam(command);
  }
};

TEST_F(Plugin, OfThisVersionIsUsed) {
  const Outcome info = with(FAKE_PLUGIN);
  EXPECT_TRUE(contains(info.out, "device 0: paper device, compute capability 9.0")) << info.out << info.err;
  EXPECT_TRUE(contains(info.out, "auto       cpu (paper device cannot be used: it is made of paper)")) << info.out;
  const Outcome run =
      with(FAKE_PLUGIN, fmt::format("run '{}' --backend cuda --out {}", write_scene().string(), path("out")));
  EXPECT_EQ(run.code, 1);
  EXPECT_TRUE(contains(run.err, "backend cuda was asked for but cannot run: paper device")) << run.err;
}

/// If no variable names the plugin's folder, the plugin is found in the folder of the library, as after installation.
TEST_F(Plugin, BesideTheLibraryIsFound) {
  fs::create_symlink(MACADAM_LIBRARY, folder_ / fs::path(MACADAM_LIBRARY).filename());
  setenv("LD_LIBRARY_PATH", folder_.c_str(), 1);  // the dynamic linker finds the library in this folder
  unsetenv("MACADAM_PLUGIN_PATH");
  const Outcome info = with(FAKE_PLUGIN);
  unsetenv("LD_LIBRARY_PATH");
  EXPECT_TRUE(contains(info.out, "device 0: paper device, compute capability 9.0")) << info.out << info.err;
}

TEST_F(Plugin, OfAnotherInterfaceIsRefused) {
  const Outcome info = with(FAKE_OLD_PLUGIN);
  EXPECT_TRUE(contains(info.out, "cuda       no: ")) << info.out;
  EXPECT_TRUE(contains(info.out, "(interface 99), expected a plugin of Macadam ")) << info.out;
  const Outcome run =
      with(FAKE_OLD_PLUGIN, fmt::format("run '{}' --backend cuda --out {}", write_scene().string(), path("out")));
  EXPECT_EQ(run.code, 1);
  EXPECT_TRUE(contains(run.err, "(interface 99)")) << run.err;
}

TEST_F(Plugin, AnotherFileIsNone) {
  const Outcome info = with(folder_ / "t8.csv");
  EXPECT_EQ(info.code, 0);
  EXPECT_TRUE(contains(info.out, "cuda       no: " + (folder_ / "libmacadam_cuda.so").string())) << info.out;
}

TEST_F(Plugin, ALibraryOfSomebodyElseIsNone) {
  const Outcome info = with(FAKE_EMPTY_PLUGIN);
  EXPECT_TRUE(contains(info.out, "is not a plugin of Macadam")) << info.out;
}

}  // namespace
}  // namespace macadam::test
