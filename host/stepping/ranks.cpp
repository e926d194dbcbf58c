// SPDX-License-Identifier: GPL-3.0-or-later
// ranks.cpp  Whether this process is one of several that mpirun began. What joins them is a library of its own,
// libmacadam_ranks.so: nobody else needs MPI and NCCL.
#include "macadam/ranks.hpp"

#include <cstdlib>

#include "host/stepping/plugin_file.hpp"
#include "host/stepping/rank_device.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// How many processes were begun together, by what their starter says: Open MPI, then MPICH and Slurm.
int processes_begun() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    if (const char* value = std::getenv(name)) return std::atoi(value);
  }
  return 1;
}

Ranks* join() {
  if (processes_begun() < 2) return nullptr;
  std::string why;
  const PluginFile asked{"libmacadam_ranks.so", "macadam_ranks_plugin", ranks_interface, "MPI, NCCL and CUDA"};
  const auto* plugin = static_cast<const RanksPlugin*>(find_plugin(asked, why));
  if (!plugin) {
    throw RunError(std::to_string(processes_begun()) +
                   " processes were begun to run together, and this one cannot join the others: " + why);
  }
  return plugin->join();
}

}  // namespace

void Ranks::require_same(const std::string& what, std::int64_t value) {
  const auto least_of = [this](std::int64_t n) { return static_cast<std::int64_t>(least(static_cast<double>(n))); };
  const std::int64_t low = least_of(value), high = -least_of(-value);
  if (low == high) return;
  throw RunError("ranks: " + what + ": found " + std::to_string(low) + " and " + std::to_string(high) +
                 ", expected the same of all: they no longer run the same scene");
}

DeviceList device_of(const Ranks& team) {
  const std::vector<DeviceInfo> devices = report_backends().devices;
  if (devices.empty()) return {};
  return {devices[static_cast<std::size_t>(team.number_on_host()) % devices.size()].number};
}

Ranks* ranks() {
  static Ranks* const joined = join();
  return joined;
}

}  // namespace macadam
