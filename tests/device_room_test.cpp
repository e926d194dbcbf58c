// SPDX-License-Identifier: GPL-3.0-or-later
// device_room_test.cpp  Whose steps have the multiprocessors of a device. Events are addresses here: no device is
// needed.
#include "kernels/device_room.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace macadam::kernels {
namespace {

using namespace std::chrono_literals;
using Share = DeviceRoom::Share;
using Event = DeviceRoom::Event;

/// A specimen that takes so many of the 100 multiprocessors of a device of its own.
class Specimen {
 public:
  explicit Specimen(Share share) : share_(std::move(share)) {}
  /// On its way in a thread of its own; what it waits for on the device.
  std::future<Event> takes() {
    return std::async(std::launch::async, [this] {
      Share all;
      for (const auto& [device, number] : share_) all[device] = 100;
      return DeviceRoom::take(number_, share_, all);
    });
  }
  void queues_all() { DeviceRoom::is_queued(number_, end()); }
  void gives() { DeviceRoom::give(number_); }
  Event end() { return &end_; }

 private:
  std::uint64_t number_ = DeviceRoom::next_number();
  Share share_;
  char end_ = 0;
};

bool waits(std::future<Event>& taken) { return taken.wait_for(50ms) == std::future_status::timeout; }

TEST(DeviceRoom, ASecondSpecimenIsQueuedBehindTheStepsOfTheFirst) {
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

// The specimen that is there longest goes first, however large it is, and though it asks last.
TEST(DeviceRoom, GivesTurnsByTheSpecimensNumbers) {
  const DeviceRoom::Share whole{{700, 10}}, small{{700, 4}}, other{{701, 1}}, of_device{{700, 10}, {701, 10}};
  std::mutex mutex;
  std::vector<char> order;
  const std::uint64_t first = DeviceRoom::next_number();
  for (std::uint64_t k = 1; k < 5; ++k) ASSERT_EQ(DeviceRoom::next_number(), first + k);
  const auto take = [&](std::uint64_t number, const DeviceRoom::Share& share, char name) {
    DeviceRoom::take(first + number, share, of_device);
    {
      const std::lock_guard lock(mutex);
      order.push_back(name);
    }
    DeviceRoom::give(first + number);
  };
  const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(300)); };
  DeviceRoom::take(first, small, of_device);
  std::thread young([&] { take(4, whole, 'y'); });
  wait();  // so that it waits before the next comes
  std::thread large([&] { take(2, whole, 'L'); });
  wait();
  std::thread late([&] { take(3, small, 's'); });  // there would be room, but not its turn
  wait();
  take(1, other, 'o');  // another device is free
  DeviceRoom::give(first);
  for (std::thread* t : {&young, &large, &late}) t->join();
  EXPECT_EQ(order, (std::vector<char>{'o', 'L', 's', 'y'}));
}

TEST(DeviceRoom, SmallSpecimensAreSideBySide) {
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

TEST(DeviceRoom, SpecimensOnSeveralDevicesWaitForAllOfThem) {
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

TEST(DeviceRoom, ShortKernelsGetPausesOnTheirDevice) {
  Specimen a(Share{{5, 90}}), b(Share{{5, 90}}), c(Share{{6, 90}}), d(Share{{6, 90}});
  a.takes().get();
  c.takes().get();
  std::future<Event> second, other;
  {
    const DeviceRoom::ShortKernels solution({5});
    EXPECT_TRUE(DeviceRoom::leaves_pauses(5));
    EXPECT_FALSE(DeviceRoom::leaves_pauses(6));
    a.queues_all();
    c.queues_all();
    second = b.takes();
    EXPECT_TRUE(waits(second));
    EXPECT_EQ(d.takes().get(), c.end());
  }
  EXPECT_FALSE(DeviceRoom::leaves_pauses(5));
  EXPECT_EQ(second.get(), a.end());
  for (Specimen* s : {&a, &b, &c, &d}) s->gives();
}

}  // namespace
}  // namespace macadam::kernels
