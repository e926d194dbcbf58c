// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rank_device.hpp  Which device is whose, of several processes; and whether there can be several.
#pragma once

#include <string>

#include "macadam/backend.hpp"
#include "macadam/ranks.hpp"

namespace macadam {

/// The device of this rank: the ranks of a host have those that are asked for, or all, in order. As asked where none
/// answers. \throws InputError for one that is not there, and for more ranks than devices.
DeviceList device_of(const Ranks& team, const DeviceList& asked);

/// Why join_ranks() can join nobody here; empty where it can.
std::string why_no_ranks();

}  // namespace macadam
