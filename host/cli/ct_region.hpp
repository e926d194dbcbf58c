// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_region.hpp  --region of the commands for scans.
#pragma once

#include <string>

#include "macadam/ct.hpp"

namespace macadam {

/// found, whole, cylinder, prism, cylinder:x,y,diameter[,z0,z1] or prism:x0,y0,z0,x1,y1,z1. \throws InputError.
void read_region(const std::string& text, SegmentOptions& options);

}  // namespace macadam
