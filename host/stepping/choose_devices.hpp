// SPDX-License-Identifier: GPL-3.0-or-later
/// \file choose_devices.hpp  How many devices step a specimen where nobody has said it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "macadam/backend.hpp"

namespace macadam {

/// Whether a device could help another, and nobody uses it.
using IdleBeside = std::function<bool(int device, int first)>;

/// Those of `devices` that step a specimen of so many contacts, none having been named: the first and, where more pay,
/// idle ones. `decision`: a sentence where these are several. Empty without devices.
DeviceList choose_devices(std::size_t contacts, const std::vector<DeviceInfo>& devices, const IdleBeside& idle_beside,
                          std::string& decision);
/// The same of this machine's devices.
DeviceList choose_devices(std::size_t contacts, std::string& decision);

}  // namespace macadam
