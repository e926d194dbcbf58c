// SPDX-License-Identifier: GPL-3.0-or-later
// ranks.cpp  Joins the processes that mpirun started together with this one. The code that uses MPI and NCCL is a
// separate library, libmacadam_ranks.so, so that only multi-process runs need MPI and NCCL.
#include "macadam/ranks.hpp"

#include <cstdlib>

#include "host/backends/cuda_code.hpp"
#include "host/backends/plugin_file.hpp"
#include "host/backends/rank_device.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

Ranks* joined = nullptr;

/// Returns the table of the plugin. Without a usable plugin, returns nullptr and stores the reason in `why`.
const RanksPlugin* find(std::string& why) {
  const PluginFile asked{"libmacadam_ranks.so", "macadam_ranks_plugin", ranks_interface, "MPI, NCCL and CUDA"};
  return static_cast<const RanksPlugin*>(find_plugin(asked, why));
}

/// Returns the number of processes that mpirun or srun started, from the environment variables of Open MPI, MPICH and
/// Slurm.
int processes_begun() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    if (const char* value = std::getenv(name)) return std::atoi(value);
  }
  return 1;
}

}  // namespace

DeviceList device_of(const Ranks& team, const DeviceList& asked) {
  if (report_backends().devices.empty()) return asked;
  DeviceList devices = device_numbers(asked.empty() ? DeviceList{every_device} : asked);
  const auto own = static_cast<std::size_t>(team.number_on_host());
  // The launcher (mpirun) may make a single device visible to each process, a different one for each process. If two
  // processes share a device, NCCL reports the error.
  if (devices.size() == 1) return devices;
  if (own >= devices.size()) {
    throw InputError("ranks: found " + std::to_string(team.count_on_host()) + " ranks on this host with " +
                     std::to_string(devices.size()) + " CUDA devices, expected one rank per device");
  }
  return {devices[own]};
}

std::string why_no_ranks() {
  std::string why;
  find(why);
  return why;
}

Ranks* join_ranks() {
  if (joined) return joined;
  std::string why;
  const RanksPlugin* const plugin = find(why);
  if (!plugin) throw RunError("ranks: this process cannot join the other processes that mpirun started: " + why);
  Ranks* const found = plugin->join();
  if (found->count() == 1 && processes_begun() > 1) {
    throw RunError("ranks: found 1 process, expected the " + std::to_string(processes_begun()) +
                   " processes that mpirun started; use the mpirun of the MPI library that libmacadam_ranks.so uses");
  }
  if (found->count() > 1) return joined = found;
  found->leave();
  return nullptr;
}

Ranks* ranks() { return joined; }

}  // namespace macadam
