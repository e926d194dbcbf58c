// SPDX-License-Identifier: GPL-3.0-or-later
// limited_memory.cpp  exec() of the program itself.
#include "host/cli/limited_memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>

namespace macadam {

void restart_with_one_blas_thread_where_memory_is_limited(char** argv) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  if (setenv("OPENBLAS_NUM_THREADS", "1", 0) != 0) return;
  constexpr const char* done = "MACADAM_RESTARTED";  // or it would go on for ever
  if (std::getenv(done) || setenv(done, "1", 1) != 0) return;
  ::execv("/proc/self/exe", argv);  // where that fails, the program goes on as it is
}

}  // namespace macadam
