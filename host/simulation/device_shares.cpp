// SPDX-License-Identifier: GPL-3.0-or-later
// device_shares.cpp  Chooses devices by the number of their scenes and by the work that is left.
#include "host/simulation/device_shares.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace macadam {
namespace {

/// A scene moves to another device only if the move saves at least this fraction of its remaining work. For each move a
/// new stepper (the object that performs the time steps) must be made. Making it takes some hundredths of the time of
/// the steps of one frequency.
constexpr double worth_a_move = 0.125;

}  // namespace

int DeviceShares::running(int device) const {
  return static_cast<int>(
      std::ranges::count_if(placed_, [&](const auto& entry) { return entry.second.device == device; }));
}

std::optional<int> DeviceShares::choose(const DeviceList& may, int most) const {
  int fewest = most;
  for (const int d : may) fewest = std::min(fewest, running(d));
  const auto rank = [&](int d) {
    const auto got = got_.find(d);
    const int now = running(d);
    return std::tuple(now >= std::min(most, fewest + 2), now > 0, got == got_.end() ? 0 : got->second);
  };
  const int least = *std::ranges::min_element(may, {}, rank);
  if (running(least) >= most) return std::nullopt;
  return least;
}

void DeviceShares::put(std::size_t scene, int device, DeviceList may) {
  placed_[scene] = {device, std::move(may), std::nullopt};
  ++got_[device];
  --to_come_;
}

int DeviceShares::device_for_next_frequency(std::size_t scene, double work, int most) {
  Placed& own = placed_.at(scene);
  own.left = work;
  largest_ = std::max(largest_, work);
  if (to_come_ > 0) return own.device;
  const auto of_others = [&](int device) {
    double sum = 0;
    for (const auto& [other, placed] : placed_)
      if (other != scene && placed.device == device) sum += placed.left.value_or(largest_);
    return sum;
  };
  double least = of_others(own.device) - worth_a_move * work;
  for (const int d : own.may) {
    if (d == own.device || running(d) >= most || of_others(d) >= least) continue;
    least = of_others(d);
    own.device = d;
  }
  return own.device;
}

void DeviceShares::end(std::size_t scene) {
  if (placed_.erase(scene) == 0) --to_come_;
}

}  // namespace macadam
