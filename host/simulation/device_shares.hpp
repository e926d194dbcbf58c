// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_shares.hpp  Which device a scene takes, where several scenes are spread over several devices.
#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "macadam/backend.hpp"

namespace macadam {

/// Keeps account of some scenes, by number, and of the devices that they are on.
class DeviceShares {
 public:
  explicit DeviceShares(std::size_t scenes) : to_come_(scenes) {}

  /// Of the devices that a scene may take, one that is idle, or the one that got the fewest so far, unless it runs two
  /// more than another: most scenes are alike, and so all devices end at about the same time. None where each runs
  /// `most` scenes.
  std::optional<int> choose(const DeviceList& may, int most) const;
  /// A scene has its place: on `device`, and later on any that it may take.
  void put(std::size_t scene, int device, DeviceList may);
  /// So much work is left of a scene that is on a device: the device that it goes to. Once no scene is to come, that is
  /// the one where the others leave the least to do, if this is worth a stepper of its own. So the devices end
  /// together though scenes differ, and are all used by fewer scenes than a multiple of theirs.
  int go_on(std::size_t scene, double work, int most);
  /// A scene is done, or has failed, whether or not it had a place.
  void end(std::size_t scene);

 private:
  struct Placed {
    int device;
    DeviceList may;
    std::optional<double> left;  ///< work, once it is known
  };
  int running(int device) const;

  std::size_t to_come_;  ///< scenes that have no place yet
  std::map<std::size_t, Placed> placed_;
  std::map<int, int> got_;  ///< scenes that a device was chosen for
  double largest_ = 0;      ///< work that was left of any: taken for what is not known yet
};

}  // namespace macadam
