// SPDX-License-Identifier: GPL-3.0-or-later
/// \file lengths.hpp  Lengths on the command line: "0.75 mm", or a bare number of metres.
#pragma once

#include <string>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam {

/// The length [m]. \throws InputError naming the option.
double length_of(const std::string& text, const std::string& option);

/// One length for all axes, or three: edges of voxels, sides of boxes [m]. \throws InputError naming the option, also
/// where one is not positive.
Vec3d lengths_of(const std::vector<std::string>& texts, const std::string& option);

}  // namespace macadam
