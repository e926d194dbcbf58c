// SPDX-License-Identifier: GPL-3.0-or-later
// draw_results.cpp  Finds a script of share/macadam and a Python that can run it.
#include "host/cli/draw_results.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>

extern char** environ;

namespace macadam {
namespace {

namespace fs = std::filesystem;

/// Beside an installed program, or where it was built from; empty where it is in neither place.
fs::path find(const std::string& script) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const fs::path& file : {program.parent_path().parent_path() / "share/macadam" / script,
                               fs::path(MACADAM_SOURCE) / "scripts" / script}) {
    if (fs::is_regular_file(file, error)) return file;
  }
  return {};
}

/// Runs a program of the search path, or of a path, with its output thrown away. Whether it ended with 0.
bool runs(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return false;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::string draw_results(const std::string& script, const fs::path& folder, const std::string& pictures) {
  const fs::path file = find(script);
  if (file.empty()) return fmt::format("no pictures: share/macadam/{} is not installed beside the program\n", script);
  // a python3 of somebody's own comes first in the search path and may lack what Debian's has
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (runs({python, "-B", file.string(), folder.string()})) return fmt::format("pictures: {}\n", pictures);
  return fmt::format("no pictures: they take python3 with matplotlib; where that is, python3 {} {} draws them\n",
                     file.string(), folder.string());
}

}  // namespace macadam
