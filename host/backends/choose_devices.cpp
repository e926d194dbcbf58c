// SPDX-License-Identifier: GPL-3.0-or-later
// choose_devices.cpp  Chooses the devices (GPUs) of a run if the user does not name any: several devices if they make
// steps faster and no other process uses them, otherwise one.
#include "host/backends/choose_devices.hpp"

#include <fmt/format.h>

#include "host/backends/cuda_code.hpp"

namespace macadam {
namespace {

/// Number of contacts from which several devices are worthwhile. Two H100 step 221,000 contacts 1.2 times as fast as
/// one H100. Two H100 step 441,000 contacts 4 times as fast as one, because 441,000 contacts do not fit in the
/// registers and shared memory of one H100 (bench/results/team-*.csv).
constexpr std::size_t contacts_of_a_team = 300'000;
// Smallest number of contacts per device when there are several.
constexpr std::size_t contacts_of_a_device = 150'000;

}  // namespace

DeviceList choose_devices(std::size_t contacts, const std::vector<DeviceInfo>& devices, const IdleBeside& idle_beside,
                          std::string& decision) {
  if (devices.empty()) return {};
  const int first = devices.front().number;
  DeviceList out{first};
  const std::size_t most = contacts < contacts_of_a_team ? 1 : contacts / contacts_of_a_device;
  for (std::size_t k = 1; k < devices.size() && out.size() < most; ++k) {
    if (idle_beside(devices[k].number, first)) out.push_back(devices[k].number);
  }
  if (out.size() > 1) {
    decision = fmt::format(
        "devices {}: several devices step {} contacts faster than one device, and these devices were idle; --device "
        "{} uses only one",
        to_string(out), contacts, first);
  }
  return out;
}

DeviceList choose_devices(std::size_t contacts, std::string& decision) {
  const kernels::CudaCode* code = cuda_code();
  if (!code) return {};
  const auto idle_beside = [&](int device, int first) {
    return code->idle_beside(device, first) && code->refusal(device).empty();
  };
  return choose_devices(contacts, report_backends().devices, idle_beside, decision);
}

}  // namespace macadam
