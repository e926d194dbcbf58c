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
///
/// A solution in the frequency domain goes before all steps that need room, and has its devices to itself but for steps
/// that need none. It is hundreds of short kernels one after the other, of which each would else wait for steps to end.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
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
  /// Makes what is queued from now on wait for an event.
  using QueueBehind = std::function<void(Event)>;
  /// What needs room.
  enum class Work { steps, solution };

  /// The number of a specimen that is to be stepped, or of a solution. Numbers of a kind rise; those of all solutions
  /// are below those of all specimens.
  static std::uint64_t next_number(Work work = Work::steps) {
    constexpr std::uint64_t first_of_steps = std::uint64_t{1} << 63;
    DeviceRoom& room = instance();
    const std::lock_guard lock(room.mutex_);
    return room.next_++ + (work == Work::steps ? first_of_steps : 0);
  }
  /// Waits until it is the turn of `wanted`: no lower number waits for one of these devices, and all of it is free, or
  /// will be at an event. Then `queue_behind` is called with that event before its owner can give its room back, so
  /// that the event still exists. `of_device`: what each device has.
  static void take(std::uint64_t number, const Share& wanted, const Share& of_device, const QueueBehind& queue_behind) {
    DeviceRoom& room = instance();
    std::unique_lock lock(room.mutex_);
    room.waiting_[number] = wanted;
    Event end = nullptr;
    room.changed_.wait(lock, [&] {
      end = nullptr;
      return room.is_first(number) && (room.is_free(wanted, of_device) || (end = room.end_before(wanted)));
    });
    room.waiting_.erase(number);
    room.changed_.notify_all();  // who is next may have room beside this one, or in its place
    if (end) queue_behind(end);
    room.taken_[number] = {wanted, nullptr};
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
  /// Returns whether a specimen or solution waits for its turn.
  static bool waits(std::uint64_t number) {
    DeviceRoom& room = instance();
    const std::lock_guard lock(room.mutex_);
    return room.waiting_.contains(number);
  }
  static void give(std::uint64_t number) {
    DeviceRoom& room = instance();
    {
      const std::lock_guard lock(room.mutex_);
      room.taken_.erase(number);
    }
    room.changed_.notify_all();
  }

  /// While it lives, nobody else has room on the devices of a solution.
  class ForSolution {
   public:
    ForSolution(const DeviceList& devices, const QueueBehind& queue_behind) {
      constexpr int more_than_any_has = 1 << 20;
      Share whole;
      for (const int device : devices) whole[device] = more_than_any_has;
      take(number_, whole, whole, queue_behind);
    }
    ForSolution(const ForSolution&) = delete;
    ~ForSolution() { give(number_); }

   private:
    const std::uint64_t number_ = next_number(Work::solution);
  };

 private:
  struct Taken {
    Share share;
    Event end = nullptr;  // behind all that is queued there; null: there is more to come
  };

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
  std::map<std::uint64_t, Taken> taken_;    // by numbers
  std::map<std::uint64_t, Share> waiting_;  // by numbers
  std::uint64_t next_ = 0;
};

}  // namespace macadam::kernels
