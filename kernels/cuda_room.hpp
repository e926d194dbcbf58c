// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_room.hpp  Who may have the multiprocessors of a device, where several specimens share it.
///
/// The blocks of a launch of tiles on the chip wait for one another, and each has a multiprocessor to itself. Where two
/// such launches each had some of the multiprocessors that they need, neither would end. So a specimen takes as many as
/// it has tiles before it launches, and gives them back when its steps are done.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>

namespace macadam::kernels {

class DeviceRoom {
 public:
  /// Number of multiprocessors, by device.
  using Share = std::map<int, int>;

  /// Waits until all of `wanted` is free. `of_device`: what each device has.
  static void take(const Share& wanted, const Share& of_device) {
    DeviceRoom& room = instance();
    std::unique_lock lock(room.mutex_);
    room.changed_.wait(lock, [&] {
      for (const auto& [device, number] : wanted) {
        if (room.taken_[device] > 0 && room.taken_[device] + number > of_device.at(device)) return false;
      }
      return true;
    });
    for (const auto& [device, number] : wanted) room.taken_[device] += number;
  }
  static void give(const Share& share) {
    DeviceRoom& room = instance();
    {
      const std::lock_guard lock(room.mutex_);
      for (const auto& [device, number] : share) room.taken_[device] -= number;
    }
    room.changed_.notify_all();
  }

 private:
  static DeviceRoom& instance() {
    static DeviceRoom room;
    return room;
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<int, int> taken_;
};

}  // namespace macadam::kernels
