// SPDX-License-Identifier: GPL-3.0-or-later
// programs.cpp  Starts programs without a shell.
#include "host/cli/terminal/programs.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

extern char** environ;

namespace macadam {
namespace {

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> out;
  for (std::string& word : words) out.push_back(word.data());
  out.push_back(nullptr);
  return out;
}

}  // namespace

std::filesystem::path own_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

std::filesystem::path source_tree() {
  const std::filesystem::path folder = own_program().parent_path();
  std::error_code error;
  if (folder.empty() || !std::filesystem::exists(folder / "CMakeCache.txt", error)) return {};
  return (folder / MACADAM_SOURCE).lexically_normal();
}

std::string python_interpreter() {
  if (const char* const named = std::getenv("MACADAM_PYTHON"); named && *named) return named;
  const std::filesystem::path own = source_tree() / "build/python/bin/python3";
  std::error_code error;
  return own.is_absolute() && std::filesystem::exists(own, error) ? own.string() : "python3";
}

bool runs(std::vector<std::string> words) {
  const std::vector<char*> arguments = pointers_to(words);
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

std::string become(std::vector<std::string> words) {
  const std::vector<char*> arguments = pointers_to(words);
  ::execvp(arguments.front(), arguments.data());
  return std::strerror(errno);
}

}  // namespace macadam
