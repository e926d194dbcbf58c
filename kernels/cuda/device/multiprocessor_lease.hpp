// SPDX-License-Identifier: GPL-3.0-or-later
/// \file multiprocessor_lease.hpp  Decides which specimen may use the multiprocessors of a device if several specimens
/// share it.
///
/// The thread blocks of a launch of resident tiles wait for one another, and each occupies one multiprocessor. If two
/// such launches each had only some of the multiprocessors that they need, neither would end. Before it launches, a
/// specimen takes one multiprocessor per tile (TileLaunch::lease() calls take()), and gives them back when its steps
/// have finished (give()). A Share says how many multiprocessors are taken on each device.
///
/// The oldest waiting specimen goes first. While it prepares its next steps on the host, the second oldest specimen
/// runs. So these two alternate and finish early, and the next specimens are made ready meanwhile. If all specimens
/// took turns, all would finish at the same time, and the device would be idle until the next ones are ready.
///
/// When all steps of one specimen are enqueued (is_queued()), the next specimen may already take the device. Its steps
/// are enqueued behind an event that marks the end of the first specimen's steps. So the device is not idle while the
/// host thread of the next specimen wakes up.
///
/// A solution in the frequency domain goes before all steps that need multiprocessors of their own, and these steps
/// wait until it ends. Meanwhile only steps that need no multiprocessors of their own may use its devices. A solution
/// consists of hundreds of short kernels in sequence; without this rule each of these kernels would wait for steps to
/// end.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>

#include "macadam/backend.hpp"

namespace macadam::kernels {

/// The leases of all devices of this process. All functions may be called from any thread.
class MultiprocessorLease {
 public:
  /// Number of multiprocessors of each device.
  using Share = std::map<int, int>;
  /// A CUDA event. This class only stores and passes it.
  using Event = void*;
  /// Makes everything that the caller enqueues from now on wait for an event.
  using QueueBehind = std::function<void(Event)>;
  /// Kind of work that takes multiprocessors.
  enum class Work { steps, solution };

  /// Returns a number for a specimen that is to be stepped, or for a solution. Lower numbers go first. Later calls for
  /// the same kind of work return higher numbers. All numbers of solutions are below all numbers of specimens.
  static std::uint64_t next_number(Work work = Work::steps) {
    constexpr std::uint64_t first_of_steps = std::uint64_t{1} << 63;
    MultiprocessorLease& leases = instance();
    const std::lock_guard lock(leases.mutex_);
    return leases.next_++ + (work == Work::steps ? first_of_steps : 0);
  }
  /// Takes the multiprocessors `wanted` for the specimen or solution `number` (see next_number()). Waits until no
  /// specimen or solution with a lower number waits for any of the same devices, and all wanted multiprocessors are
  /// free or will be free after a known event. In the latter case, calls `queue_behind` with this event. The lock is
  /// still held during that call, so that the owner of the event cannot destroy the event meanwhile. `of_device`:
  /// number of multiprocessors that each device has.
  static void take(std::uint64_t number, const Share& wanted, const Share& of_device, const QueueBehind& queue_behind) {
    MultiprocessorLease& leases = instance();
    std::unique_lock lock(leases.mutex_);
    leases.waiting_[number] = wanted;
    Event end = nullptr;
    leases.changed_.wait(lock, [&] {
      end = nullptr;
      return leases.is_first(number) && (leases.is_free(wanted, of_device) || (end = leases.end_before(wanted)));
    });
    leases.waiting_.erase(number);
    leases.changed_.notify_all();  // the next specimen in the queue may now be able to take multiprocessors
    if (end) queue_behind(end);
    leases.taken_[number] = {wanted, nullptr};
  }
  /// Reports that all work of a specimen is enqueued; `end` is the event behind it.
  static void is_queued(std::uint64_t number, Event end) {
    MultiprocessorLease& leases = instance();
    {
      const std::lock_guard lock(leases.mutex_);
      leases.taken_.at(number).end = end;
    }
    leases.changed_.notify_all();
  }
  /// Returns whether a specimen or solution waits for its turn.
  static bool waits(std::uint64_t number) {
    MultiprocessorLease& leases = instance();
    const std::lock_guard lock(leases.mutex_);
    return leases.waiting_.contains(number);
  }
  /// Gives back what `number` has taken.
  static void give(std::uint64_t number) {
    MultiprocessorLease& leases = instance();
    {
      const std::lock_guard lock(leases.mutex_);
      leases.taken_.erase(number);
    }
    leases.changed_.notify_all();
  }

  /// Takes the devices of a solution for its lifetime; nobody else can take them.
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
    Event end = nullptr;  // event behind all enqueued work; null: more will be enqueued
  };

  /// Returns whether no lower number waits for one of the same devices.
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
  /// Returns whether enough multiprocessors are free for `wanted`. A device that nobody uses always suffices.
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
  /// If only one device is wanted, and exactly one specimen holds it and holds no other device, returns the event at
  /// the end of that specimen's enqueued work; else null.
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
  static MultiprocessorLease& instance() {
    static MultiprocessorLease leases;
    return leases;
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::uint64_t, Taken> taken_;    // by number
  std::map<std::uint64_t, Share> waiting_;  // by number
  std::uint64_t next_ = 0;
};

}  // namespace macadam::kernels
