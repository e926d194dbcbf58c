// SPDX-License-Identifier: GPL-3.0-or-later
// memory.cpp  Reads from Linux how much memory is available: on the machine, to this process, and to its control group.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "macadam/ct.hpp"

namespace macadam {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Returns the number in the first line of a small file, or `without` if the line has no number.
double number_in(const char* file, double without) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? value : without;
}

/// Returns the free memory of the machine [bytes].
double free_of_machine() {
  std::ifstream in("/proc/meminfo");
  std::string name;
  for (double kibibytes = 0; in >> name >> kibibytes; in.ignore(std::numeric_limits<std::streamsize>::max(), '\n')) {
    if (name == "MemAvailable:") return 1024 * kibibytes;
  }
  return unlimited;
}

/// Returns how much this process may still allocate under its limit of address space (ulimit -v) [bytes].
double left_of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  const double taken = number_in("/proc/self/statm", 0) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - taken);
}

}  // namespace

double memory_available() {
  const double group = number_in("/sys/fs/cgroup/memory.max", unlimited) -
                       number_in("/sys/fs/cgroup/memory.current", 0);  // limit of a container
  return std::min({free_of_machine(), left_of_address_space(), std::max(0.0, group)});
}

}  // namespace macadam
