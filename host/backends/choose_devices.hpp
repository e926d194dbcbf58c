// SPDX-License-Identifier: GPL-3.0-or-later
/// \file choose_devices.hpp  Decides how many devices (GPUs) step a specimen if the user does not give their number.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "macadam/backend.hpp"

namespace macadam {

/// Returns whether `device` can step a specimen together with `first` (it is of the same model, and each reaches the
/// memory of the other) and no process uses it.
using IdleBeside = std::function<bool(int device, int first)>;

/// Returns the devices that step a specimen with this number of contacts: the first of `devices` and, if several
/// devices are worthwhile, further idle devices. If several are returned, `decision` is set to a sentence for the user.
/// Returns an empty list on a machine without devices.
DeviceList choose_devices(std::size_t contacts, const std::vector<DeviceInfo>& devices, const IdleBeside& idle_beside,
                          std::string& decision);
/// Chooses as above among the devices of this machine.
DeviceList choose_devices(std::size_t contacts, std::string& decision);

}  // namespace macadam
