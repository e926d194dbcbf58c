// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_room.hpp  Who may have the multiprocessors of a device, where several specimens share it.
///
/// The blocks of a launch of tiles on the chip wait for one another, and each has a multiprocessor to itself. Where two
/// such launches each had some of the multiprocessors that they need, neither would end. So a specimen takes as many as
/// it has tiles before it launches, and gives them back when its steps are done. Of those that wait, the specimen that
/// was there first goes first: so the oldest two take turns, and are done while others are still being prepared. If all
/// took turns, all would end at the same time, and the device would stand still until the next ones are there.
///
/// A device whose multiprocessors one specimen has, all of whose steps are queued, may be taken by the next one
/// already: its steps are queued behind an event at the end of those. So the device has no pause in which hosts wake
/// each other.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>

#include "macadam/backend.hpp"

namespace macadam::kernels {

class DeviceRoom {
 public:
  /// Number of multiprocessors, by device.
  using Share = std::map<int, int>;
  /// An event of CUDA, of which nothing but its place is looked at here.
  using Event = void*;

  /// The number of a specimen that is to be stepped: one more than that of the specimen before.
  static std::uint64_t next_number() {
    DeviceRoom& room = instance();
    const std::lock_guard lock(room.mutex_);
    return room.next_++;
  }
  /// Waits until it is the turn of `wanted`: no specimen with a lower number waits for one of these devices, and all of
  /// it is free, or will be at the event that is returned, which what is queued must wait for. `of_device`: what each
  /// device has.
  static Event take(std::uint64_t number, const Share& wanted, const Share& of_device) {
    DeviceRoom& room = instance();
    std::unique_lock lock(room.mutex_);
    room.waiting_[number] = wanted;
    Event end = nullptr;
    room.changed_.wait(lock, [&] {
      end = nullptr;
      return room.is_first(number) && (room.is_free(wanted, of_device) || (end = room.end_before(wanted)));
    });
    room.waiting_.erase(number);
    room.taken_[number] = {wanted, nullptr};
    lock.unlock();
    room.changed_.notify_all();  // who is next may have room beside this one
    return end;
  }
  /// All that a specimen does in its room is queued, and `end` behind it.
  static void is_queued(std::uint64_t number, Event end) {
    DeviceRoom& room = instance();
    {
      const std::lock_guard lock(room.mutex_);
      room.taken_.at(number).end = end;
    }
    room.changed_.notify_all();
  }
  static void give(std::uint64_t number) {
    DeviceRoom& room = instance();
    {
      const std::lock_guard lock(room.mutex_);
      room.taken_.erase(number);
    }
    room.changed_.notify_all();
  }

  /// Whether steps on this device are to leave pauses.
  static bool leaves_pauses(int device) {
    DeviceRoom& room = instance();
    const std::lock_guard lock(room.mutex_);
    return room.has_short_kernels(device);
  }

  /// While it lives, many short kernels run on these devices one after the other, each as soon as a multiprocessor is
  /// free: steps leave pauses for them.
  class ShortKernels {
   public:
    explicit ShortKernels(const DeviceList& devices) : devices_(devices) { count(+1); }
    ShortKernels(const ShortKernels&) = delete;
    ~ShortKernels() { count(-1); }

   private:
    void count(int change) {
      DeviceRoom& room = instance();
      {
        const std::lock_guard lock(room.mutex_);
        for (const int device : devices_) room.short_kernels_[device] += change;
      }
      room.changed_.notify_all();
    }
    DeviceList devices_;
  };

 private:
  struct Taken {
    Share share;
    Event end = nullptr;  // behind all that is queued there; null: there is more to come
  };

  bool has_short_kernels(int device) const {
    const auto found = short_kernels_.find(device);
    return found != short_kernels_.end() && found->second > 0;
  }
  bool is_first(std::uint64_t mine) const {
    const Share& wanted = waiting_.at(mine);
    for (const auto& [earlier, others] : waiting_) {
      if (earlier == mine) break;
      for (const auto& [device, number] : others) {
        if (wanted.contains(device)) return false;
      }
    }
    return true;
  }
  bool is_free(const Share& wanted, const Share& of_device) const {
    for (const auto& [device, number] : wanted) {
      int used = 0;
      for (const auto& [specimen, taken] : taken_) {
        const auto part = taken.share.find(device);
        if (part != taken.share.end()) used += part->second;
      }
      if (used > 0 && used + number > of_device.at(device)) return false;
    }
    return true;
  }
  /// Where one specimen alone has the one device that is wanted, and no other: the end of all that it has queued.
  Event end_before(const Share& wanted) const {
    if (wanted.size() != 1) return nullptr;
    const int device = wanted.begin()->first;
    if (has_short_kernels(device)) return nullptr;
    const Taken* only = nullptr;
    for (const auto& [specimen, taken] : taken_) {
      if (!taken.share.contains(device)) continue;
      if (only || taken.share.size() > 1) return nullptr;
      only = &taken;
    }
    return only ? only->end : nullptr;
  }
  static DeviceRoom& instance() {
    static DeviceRoom room;
    return room;
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::uint64_t, Taken> taken_;    // by the specimens' numbers
  std::map<std::uint64_t, Share> waiting_;  // by the specimens' numbers
  std::map<int, int> short_kernels_;        // by device
  std::uint64_t next_ = 0;
};

}  // namespace macadam::kernels
