// SPDX-License-Identifier: GPL-3.0-or-later
// choose_devices.cpp  A second device is taken unasked where it pays, and where it is nobody else's.
#include "host/stepping/choose_devices.hpp"

#include <fmt/format.h>

#include "host/stepping/cuda_code.hpp"

namespace macadam {
namespace {

/// Of two H100, the second makes steps of 221,000 contacts 1.2 times as fast, and of 441,000, which are too many for
/// the chip of one, 4 times (bench/results/team-*.csv).
constexpr std::size_t contacts_of_a_team = 300'000;
constexpr std::size_t contacts_of_a_device = 150'000;  // at the least, in a team

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
        "devices {}: several step {} contacts faster, and no process used the others; --devices {} takes one",
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
