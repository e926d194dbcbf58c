// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_room.hpp  Who may have the multiprocessors of a device, where several specimens share it.
///
/// The blocks of a launch of tiles on the chip wait for one another, and each has a multiprocessor to itself. Where two
/// such launches each had some of the multiprocessors that they need, neither would end. So a specimen takes as many as
/// it has tiles before it launches, and gives them back when its steps are done. Of those that
/// wait, the specimen that was there first goes first: so the oldest two take turns, and are done while others are
/// still being prepared. If all took turns, all would end at the same time, and the device would stand still until the
/// next ones are there.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>

namespace macadam::kernels {

class DeviceRoom {
 public:
  /// Number of multiprocessors, by device.
  using Share = std::map<int, int>;

  /// The number of a specimen that is to be stepped: one more than that of the specimen before.
  static std::uint64_t next_number() {
    DeviceRoom& room = instance();
    const std::lock_guard lock(room.mutex_);
    return room.next_++;
  }
  /// Waits until all of `wanted` is free and no specimen with a lower number waits for one of these devices.
  /// `of_device`: what each device has.
  static void take(std::uint64_t number, const Share& wanted, const Share& of_device) {
    DeviceRoom& room = instance();
    std::unique_lock lock(room.mutex_);
    room.waiting_[number] = wanted;
    room.changed_.wait(lock, [&] { return room.is_turn_of(number, of_device); });
    room.waiting_.erase(number);
    for (const auto& [device, taken] : wanted) room.taken_[device] += taken;
    lock.unlock();
    room.changed_.notify_all();  // who is next may have room beside this one
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
  bool is_turn_of(std::uint64_t mine, const Share& of_device) {
    const Share& wanted = waiting_.at(mine);
    for (const auto& [earlier, others] : waiting_) {
      if (earlier == mine) break;
      for (const auto& [device, number] : others) {
        if (wanted.contains(device)) return false;
      }
    }
    for (const auto& [device, number] : wanted) {
      if (taken_[device] > 0 && taken_[device] + number > of_device.at(device)) return false;
    }
    return true;
  }
  static DeviceRoom& instance() {
    static DeviceRoom room;
    return room;
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<int, int> taken_;
  std::map<std::uint64_t, Share> waiting_;  // by the specimens' numbers
  std::uint64_t next_ = 0;
};

}  // namespace macadam::kernels
