// SPDX-License-Identifier: GPL-3.0-or-later
/// \file program.hpp  Fixture for tests that run the program as a user does: a folder, a scene, a command, and its exit
/// code and output.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/test_folder.hpp"

namespace macadam::test {

/// Solver settings under which one cycle at 20 Hz takes 500 steps.
inline constexpr const char* quick = "density_scaling = 1e6\n";

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Exit code and output of a command; the code is −1 if a signal ended it.
struct Outcome {
  int code = -1;
  std::string out, err;
};

/// A folder with the specimen t8, in which the program is run.
class Program : public TestFolder {
 protected:
  /// Runs the program in a shell. Its output goes to files, so the program sees no terminal.
  Outcome macadam(const std::string& arguments) const {
    const fs::path out = folder_ / "stdout.txt", err = folder_ / "stderr.txt";
    const int status = std::system(
        fmt::format("'{}' {} >'{}' 2>'{}' </dev/null", MACADAM_PROGRAM, arguments, out.string(), err.string()).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(err)};
  }

  std::string path(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }

  /// Writes a cyclic scene of the 175 particles of t8. The specimen's path is relative to the scene file.
  fs::path write_scene(const std::string& solver = quick, const std::string& more = "") const {
    return write_scene_of("kind = \"cyclic\"\nfrequencies = [20.0]\ncycles = 1\n", solver + more);
  }

  /// Writes the same scene with another `[loading]`.
  fs::path write_scene_of(const std::string& loading, const std::string& solver = "") const {
    return write_t8(loading, solver);
  }

  Outcome run_quick(const std::string& out, const std::string& options = "--backend cpu") const {
    return macadam(fmt::format("run {} --out {} {}", path("scene.toml"), path(out), options));
  }

  nlohmann::json summary(const std::string& out) const {
    return nlohmann::json::parse(read(folder_ / out / "summary.json"));
  }
};

}  // namespace macadam::test
