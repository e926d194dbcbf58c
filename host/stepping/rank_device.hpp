// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rank_device.hpp  Which device is whose, of several processes.
#pragma once

#include "macadam/backend.hpp"
#include "macadam/ranks.hpp"

namespace macadam {

/// The device of this rank: those of a host are taken in turn by the ranks there. Empty where none answers.
DeviceList device_of(const Ranks& team);

}  // namespace macadam
