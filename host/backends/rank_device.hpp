// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rank_device.hpp  Assigns devices to the processes of a multi-process run, and tells why such a run is
/// impossible.
#pragma once

#include <string>

#include "macadam/backend.hpp"
#include "macadam/ranks.hpp"

namespace macadam {

/// Returns the device of this rank. The ranks of a host get the devices that are asked for (or all devices) in order.
/// Returns `asked` if no device responds. \throws InputError when a device is not there or a host has more ranks than
/// devices.
DeviceList device_of(const Ranks& team, const DeviceList& asked);

/// Returns why join_ranks() cannot work here; empty if it can.
std::string why_no_ranks();

}  // namespace macadam
