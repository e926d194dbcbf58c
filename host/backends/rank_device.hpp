// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rank_device.hpp  Assigns devices (GPUs) to the processes (ranks) of a multi-process run. If such a run is
/// impossible, gives the reason.
#pragma once

#include <string>

#include "macadam/backend.hpp"
#include "macadam/ranks.hpp"

namespace macadam {

/// Returns the device of this rank. The ranks of a host get the requested devices (or all devices) in order, one device
/// each. Returns `asked` if no device responds. \throws InputError when a device is not there or a host has more ranks
/// than devices.
DeviceList device_of(const Ranks& team, const DeviceList& asked);

/// Returns the reason why join_ranks() cannot work on this machine; empty if it can.
std::string why_no_ranks();

}  // namespace macadam
