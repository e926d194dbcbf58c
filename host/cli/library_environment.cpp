// SPDX-License-Identifier: GPL-3.0-or-later
// library_environment.cpp  Restarts the program by exec() of its own file.
#include "host/cli/library_environment.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>

namespace macadam {
namespace {

/// Sets an environment variable unless it is set already. Returns whether this call set it.
bool set_where_missing(const char* name, const char* value) {
  return !std::getenv(name) && setenv(name, value, 0) == 0;
}

bool is_address_space_limited() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

}  // namespace

void restart_with_library_environment(int argc, char** argv) {
  // Commands such as `macadam --version` do not restart, because a restart takes some hundredths of a second.
  const bool computes = argc > 2 || (argc == 2 && std::string_view(argv[1]) == "bench");
  bool changed = computes && !std::getenv("GOMP_SPINCOUNT") && set_where_missing("OMP_WAIT_POLICY", "passive");
  if (is_address_space_limited()) changed = set_where_missing("OPENBLAS_NUM_THREADS", "1") || changed;
  if (!changed) return;
  // The variable holds the number of the process that restarted. A program that this process starts inherits the
  // variable, but it has another process number and can restart too.
  constexpr const char* done = "MACADAM_RESTARTED";
  const char* const before = std::getenv(done);
  const std::string process = std::to_string(::getpid());
  if ((before && process == before) || setenv(done, process.c_str(), 1) != 0) return;
  ::execv("/proc/self/exe", argv);  // if this fails, the program continues with its old environment
}

}  // namespace macadam
