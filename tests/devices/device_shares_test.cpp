// SPDX-License-Identifier: GPL-3.0-or-later
// device_shares_test.cpp  Tests which device a scene is assigned to if there are several scenes and several devices.
#include "host/simulation/device_shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace macadam {
namespace {

/// Assigns scenes to any of the given devices, with at most `most` scenes per device.
class Scenes : public DeviceShares {
 public:
  Scenes(std::size_t number, DeviceList devices, int most)
      : DeviceShares(number), devices_(std::move(devices)), most_(most) {}
  /// Returns the device of the next scene, or −1 if all devices are full.
  int next() {
    const std::optional<int> device = choose(devices_, most_);
    if (!device) return -1;
    put(placed_++, *device, devices_);
    return *device;
  }
  int go_on_with(std::size_t scene, double work) { return device_for_next_frequency(scene, work, most_); }

 private:
  DeviceList devices_;
  int most_;
  std::size_t placed_ = 0;
};

TEST(DeviceShares, GivesEachDeviceAsMany) {
  Scenes scenes(10, {0, 1, 2}, 2);
  for (const int device : {0, 1, 2, 0, 1, 2, -1}) EXPECT_EQ(scenes.next(), device);
  scenes.end(4);  // scene 4 was on device 1
  EXPECT_EQ(scenes.next(), 1);
  EXPECT_EQ(scenes.next(), -1);
}

TEST(DeviceShares, AnIdleDeviceComesFirstAndABusyOneLast) {
  Scenes scenes(10, {0, 1}, 4);
  scenes.next(), scenes.next(), scenes.next();  // scenes 0 and 2 are on device 0, scene 1 on device 1
  scenes.end(0), scenes.end(2);
  EXPECT_EQ(scenes.next(), 0) << "it is idle, though it got more";
  EXPECT_EQ(scenes.next(), 1);
  // Scene 3 was on device 0. Device 0 has now had three scenes and runs none; device 1 has had two and runs both.
  scenes.end(3);
  EXPECT_EQ(scenes.next(), 0);
  scenes.end(5);
  EXPECT_EQ(scenes.next(), 0);
}

/// A scene does not move to another device as long as scenes without a device may still come.
TEST(DeviceShares, MovesNoneWhileOthersAreToCome) {
  Scenes scenes(4, {0, 1}, 4);
  scenes.next(), scenes.next(), scenes.next();
  scenes.end(1);
  for (const double work : {100.0, 10.0}) EXPECT_EQ(scenes.go_on_with(0, work), 0);
  scenes.end(3);  // this scene failed before it got a device
  EXPECT_EQ(scenes.go_on_with(0, 10), 1) << "no other is to come";
}

/// A scene moves to the device that has less work left.
TEST(DeviceShares, MovesToWhereLessIsLeft) {
  Scenes scenes(3, {0, 1}, 4);
  scenes.next(), scenes.next(), scenes.next();  // scenes 0 and 2 are on device 0, scene 1 on device 1
  EXPECT_EQ(scenes.go_on_with(1, 100), 1);
  EXPECT_EQ(scenes.go_on_with(2, 100), 0) << "the two devices have equal other work";
  EXPECT_EQ(scenes.go_on_with(0, 100), 0);
  EXPECT_EQ(scenes.go_on_with(1, 40), 1);
  EXPECT_EQ(scenes.go_on_with(2, 80), 1) << "100 are beside it on device 0, 40 on device 1";
  EXPECT_EQ(scenes.go_on_with(0, 50), 0) << "alone";
}

/// A scene moves only if the gain is large enough.
TEST(DeviceShares, MovesForNoSmallGain) {
  Scenes scenes(3, {0, 1}, 4);
  scenes.next(), scenes.next(), scenes.next();
  scenes.go_on_with(1, 95), scenes.go_on_with(0, 100);
  EXPECT_EQ(scenes.go_on_with(2, 100), 0);
  scenes.go_on_with(1, 80);
  EXPECT_EQ(scenes.go_on_with(2, 100), 1);
}

/// A scene does not move to a device that is full, or to one that is not in the scene's list of devices.
TEST(DeviceShares, MovesToNoFullAndNoForbiddenDevice) {
  Scenes full(5, {0, 1}, 2);
  for (int k = 0; k < 4; ++k) full.next();
  full.end(4);
  full.go_on_with(1, 1), full.go_on_with(3, 1);
  EXPECT_EQ(full.go_on_with(0, 100), 0);

  DeviceShares named(2);
  named.put(0, 0, {0}), named.put(1, 0, {0, 7});
  EXPECT_EQ(named.device_for_next_frequency(0, 100, 4), 0);
  EXPECT_EQ(named.device_for_next_frequency(1, 100, 4), 7);
}

// Simulates six scenes with four frequencies each. All frequencies of a scene take the same work, but the scenes
// differ. Each device steps its scenes in turn, one frequency at a time.
TEST(DeviceShares, DevicesEndTogether) {
  const std::vector<double> work{40, 52, 38, 60, 45, 58};
  Scenes scenes(work.size(), {0, 1}, 4);
  std::vector<int> device, done(work.size(), 0);
  for (std::size_t k = 0; k < work.size(); ++k) device.push_back(scenes.next());
  std::vector<double> clock(2, 0);
  std::vector<std::size_t> last(2, 0);
  for (int left = 4 * static_cast<int>(work.size()); left > 0;) {
    const int now = clock[0] <= clock[1] ? 0 : 1;
    std::size_t next = work.size();
    for (std::size_t k = 1; k <= work.size() && next == work.size(); ++k) {
      const std::size_t scene = (last[static_cast<std::size_t>(now)] + k) % work.size();
      if (device[scene] == now && done[scene] < 4) next = scene;
    }
    if (next == work.size()) {  // this device is idle
      clock[static_cast<std::size_t>(now)] = clock[static_cast<std::size_t>(1 - now)] + 1e-9;
      continue;
    }
    last[static_cast<std::size_t>(now)] = next;
    device[next] = scenes.go_on_with(next, work[next] * (4 - done[next]) / 4);
    if (device[next] != now) continue;
    clock[static_cast<std::size_t>(now)] += work[next] / 4;
    ++done[next], --left;
    if (done[next] == 4) scenes.end(next);
  }
  EXPECT_LT(std::abs(clock[0] - clock[1]), 60.0 / 4) << "the longest frequency";
}

}  // namespace
}  // namespace macadam
