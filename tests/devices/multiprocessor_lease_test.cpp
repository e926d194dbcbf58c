// SPDX-License-Identifier: GPL-3.0-or-later
// multiprocessor_lease_test.cpp  Tests the order in which steppers and harmonic solutions get the multiprocessors of a
// device (GPU). Plain addresses take the place of CUDA events here, so no device is needed.
#include "kernels/cuda/device/multiprocessor_lease.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace macadam::kernels {
namespace {

using namespace std::chrono_literals;
using Share = MultiprocessorLease::Share;
using Event = MultiprocessorLease::Event;

/// A specimen that requests, on each device, the number of multiprocessors in `share`; every device has 100.
class Specimen {
 public:
  explicit Specimen(Share share) : share_(std::move(share)) {}
  /// Requests the multiprocessors in a new thread. The result is the event that must occur on the device before the
  /// specimen's steps begin, or null if the steps wait for nothing.
  std::future<Event> takes() {
    return std::async(std::launch::async, [this] {
      Share all;
      for (const auto& [device, number] : share_) all[device] = 100;
      Event behind = nullptr;
      MultiprocessorLease::take(number_, share_, all, [&](Event end) { behind = end; });
      return behind;
    });
  }
  void queues_all() { MultiprocessorLease::is_queued(number_, end()); }
  void gives() { MultiprocessorLease::give(number_); }
  Event end() { return &end_; }

 private:
  std::uint64_t number_ = MultiprocessorLease::next_number();
  Share share_;
  char end_ = 0;
};

void nowhere(Event) {}
bool waits(std::future<Event>& taken) { return taken.wait_for(50ms) == std::future_status::timeout; }

/// While the first specimen still queues steps, the second specimen waits. When the first has queued all of its steps,
/// the steps of the second are queued behind them. Only one specimen at a time may be queued behind another.
TEST(MultiprocessorLease, ASecondSpecimenIsQueuedBehindTheStepsOfTheFirst) {
  Specimen a(Share{{0, 90}}), b(Share{{0, 90}}), c(Share{{0, 90}});
  EXPECT_EQ(a.takes().get(), nullptr);
  std::future<Event> second = b.takes();
  EXPECT_TRUE(waits(second)) << "more of the first may come";
  a.queues_all();
  EXPECT_EQ(second.get(), a.end());
  std::future<Event> third = c.takes();
  b.queues_all();
  EXPECT_TRUE(waits(third)) << "one behind another is enough";
  a.gives();
  EXPECT_EQ(third.get(), b.end());
  b.gives();
  c.gives();
  EXPECT_EQ(a.takes().get(), nullptr) << "all is free";
  std::future<Event> again = b.takes();
  EXPECT_TRUE(waits(again)) << "the end of steps before is not that of these";
  a.gives();
  EXPECT_EQ(again.get(), nullptr);
  b.gives();
}

// Specimens get their turn in the order of their numbers, which is the order of their creation, whatever their size and
// the order of their requests.
TEST(MultiprocessorLease, GivesTurnsByTheSpecimensNumbers) {
  const MultiprocessorLease::Share whole{{700, 10}}, small{{700, 4}}, other{{701, 1}}, of_device{{700, 10}, {701, 10}};
  std::mutex mutex;
  std::vector<char> order;
  const std::uint64_t first = MultiprocessorLease::next_number();
  for (std::uint64_t k = 1; k < 5; ++k) ASSERT_EQ(MultiprocessorLease::next_number(), first + k);
  const auto take = [&](std::uint64_t number, const MultiprocessorLease::Share& share, char name) {
    MultiprocessorLease::take(first + number, share, of_device, nowhere);
    {
      const std::lock_guard lock(mutex);
      order.push_back(name);
    }
    MultiprocessorLease::give(first + number);
  };
  const auto until_it_waits = [&](std::uint64_t number) {
    while (!MultiprocessorLease::waits(first + number)) std::this_thread::yield();
  };
  MultiprocessorLease::take(first, small, of_device, nowhere);
  std::thread young([&] { take(4, whole, 'y'); });
  until_it_waits(4);
  std::thread large([&] { take(2, whole, 'L'); });
  until_it_waits(2);
  std::thread late([&] { take(3, small, 's'); });  // this specimen would fit beside the first; it must wait its turn
  until_it_waits(3);
  take(1, other, 'o');  // this request is for another device, which is free
  MultiprocessorLease::give(first);
  for (std::thread* t : {&young, &large, &late}) t->join();
  EXPECT_EQ(order, (std::vector<char>{'o', 'L', 's', 'y'}));
}

/// Specimens that fit on the device together run side by side. A third one would have to be queued behind both of them,
/// so its thread waits on the host until one has finished.
TEST(MultiprocessorLease, SmallSpecimensAreSideBySide) {
  Specimen a(Share{{2, 40}}), b(Share{{2, 40}}), c(Share{{2, 40}});
  EXPECT_EQ(a.takes().get(), nullptr);
  EXPECT_EQ(b.takes().get(), nullptr);
  a.queues_all();
  b.queues_all();
  std::future<Event> third = c.takes();
  EXPECT_TRUE(waits(third)) << "it would have to wait for two";
  a.gives();
  EXPECT_EQ(third.get(), nullptr);
  b.gives();
  c.gives();
}

/// A specimen on several devices waits until each of these devices is free or lets it queue behind running steps.
TEST(MultiprocessorLease, SpecimensOnSeveralDevicesWaitForAllOfThem) {
  Specimen a(Share{{3, 90}}), both(Share{{3, 90}, {4, 90}}), b(Share{{4, 90}});
  a.takes().get();
  a.queues_all();
  std::future<Event> second = both.takes();
  EXPECT_TRUE(waits(second));
  a.gives();
  EXPECT_EQ(second.get(), nullptr);
  both.queues_all();
  std::future<Event> third = b.takes();
  EXPECT_TRUE(waits(third));
  both.gives();
  EXPECT_EQ(third.get(), nullptr);
  b.gives();
}

/// A harmonic solution in a new thread, which lasts until ends() is called. begins() returns the event that the
/// solution waits for.
class Solution {
 public:
  explicit Solution(DeviceList devices)
      : thread_([this, devices = std::move(devices)] {
          Event behind = nullptr;
          const MultiprocessorLease::ForSolution room(devices, [&](Event end) { behind = end; });
          begun_.set_value(behind);
          end_.get_future().wait();
        }) {}
  ~Solution() { ends(); }
  std::future<Event>& begins() { return taken_; }
  void ends() {
    if (!thread_.joinable()) return;
    end_.set_value();
    thread_.join();
  }

 private:
  std::promise<Event> begun_;
  std::promise<void> end_;
  std::future<Event> taken_ = begun_.get_future();
  std::thread thread_;  // declared last, because the thread uses the other members
};

/// A harmonic solution gets the device before a stepper that is waiting.
TEST(MultiprocessorLease, ASolutionGoesBeforeStepsThatWait) {
  Specimen a(Share{{5, 90}}), b(Share{{5, 90}});
  a.takes().get();
  std::future<Event> second = b.takes();
  Solution solution({5});
  EXPECT_TRUE(waits(solution.begins())) << "more of the steps may come";
  a.queues_all();
  EXPECT_EQ(solution.begins().get(), a.end());
  a.gives();
  EXPECT_TRUE(waits(second));
  solution.ends();
  EXPECT_EQ(second.get(), nullptr);
  b.gives();
}

/// A harmonic solution uses all multiprocessors of its devices; steppers on these devices wait.
TEST(MultiprocessorLease, ASolutionHasItsDevicesToItself) {
  Specimen small(Share{{6, 1}}), other(Share{{7, 1}}), elsewhere(Share{{8, 1}});
  Solution both({6, 7});
  EXPECT_EQ(both.begins().get(), nullptr);
  Solution next({7});
  EXPECT_TRUE(waits(next.begins()));
  std::future<Event> first = small.takes(), second = other.takes();
  EXPECT_TRUE(waits(first)) << "however little it takes";
  EXPECT_EQ(elsewhere.takes().get(), nullptr) << "another device is free";
  both.ends();
  EXPECT_EQ(first.get(), nullptr);
  EXPECT_EQ(next.begins().get(), nullptr);
  EXPECT_TRUE(waits(second)) << "solutions go first";
  next.ends();
  EXPECT_EQ(second.get(), nullptr);
  for (Specimen* s : {&small, &other, &elsewhere}) s->gives();
}

/// A specimen cannot release its multiprocessors while another specimen is being queued behind its event. Otherwise the
/// event could be destroyed before the other specimen has used it.
TEST(MultiprocessorLease, NobodyGivesRoomWhileAnotherIsQueuedBehind) {
  Specimen a(Share{{9, 90}});
  a.takes().get();
  a.queues_all();
  std::future<void> given;
  const MultiprocessorLease::ForSolution solution({9}, [&](Event) {
    given = std::async(std::launch::async, [&] { a.gives(); });
    EXPECT_EQ(given.wait_for(50ms), std::future_status::timeout) << "its event might be gone";
  });
  given.get();
}

/// If a harmonic solution cannot be queued behind an event, it does not keep the device.
TEST(MultiprocessorLease, WhoCannotBeQueuedHasNoRoom) {
  Specimen a(Share{{10, 90}}), b(Share{{10, 90}});
  a.takes().get();
  a.queues_all();
  EXPECT_THROW(MultiprocessorLease::ForSolution({10}, [](Event) { throw std::runtime_error("lost"); }),
               std::runtime_error);
  EXPECT_EQ(b.takes().get(), a.end());
  a.gives();
  b.gives();
}

}  // namespace
}  // namespace macadam::kernels
