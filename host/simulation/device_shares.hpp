// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_shares.hpp  Assigns devices to scenes when several scenes are spread over several devices.
#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "macadam/backend.hpp"

namespace macadam {

/// Records on which device each scene runs, and chooses devices. Scenes are given by their numbers.
class DeviceShares {
 public:
  explicit DeviceShares(std::size_t scenes) : to_come_(scenes) {}

  /// Returns the device for a new scene, out of `may`, the devices that the scene may use. Chooses an idle device or,
  /// if every device is busy, the device that has been given the fewest scenes so far; a device that runs two scenes
  /// more than another one is avoided. Most scenes are alike, so all devices end at about the same time. Returns
  /// nothing if each of these devices runs `most` scenes.
  std::optional<int> choose(const DeviceList& may, int most) const;
  /// Records that a scene runs on `device`, and that it may later move to any device of `may`.
  void put(std::size_t scene, int device, DeviceList may);
  /// Returns the device on which a scene solves its next frequency. `work`: work that remains for the scene. `most`:
  /// largest number of scenes on one device. The scene stays on its device while there are scenes that have not been
  /// given a device yet. Afterwards the function chooses the device whose other scenes have the least work left, if the
  /// move saves enough time; a move costs time because the object that takes the time steps is made again. So all
  /// devices end at about the same time, even if the scenes differ or their number is not a multiple of the number of
  /// devices.
  int device_for_next_frequency(std::size_t scene, double work, int most);
  /// Records that a scene is done or has failed, whether or not it had a device.
  void end(std::size_t scene);

 private:
  struct Placed {
    int device;
    DeviceList may;
    std::optional<double> left;  ///< remaining work, once it is known
  };
  /// Returns the number of scenes that run on a device.
  int running(int device) const;

  std::size_t to_come_;  ///< number of scenes that have had no device yet
  std::map<std::size_t, Placed> placed_;
  std::map<int, int> got_;  ///< number of scenes that were given to each device
  double largest_ = 0;  ///< largest remaining work of any scene so far; assumed for scenes whose work is not known yet
};

}  // namespace macadam
