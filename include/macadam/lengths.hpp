// SPDX-License-Identifier: GPL-3.0-or-later
/// \file lengths.hpp  Parses lengths on the command line: "0.75 mm", or a number of metres without a unit.
#pragma once

#include <string>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam {

/// Returns a length [m]. \throws InputError, naming the option, if the text is not a length.
double length_of(const std::string& text, const std::string& option);

/// Returns the lengths along x, y and z [m], for example the edges of a voxel or of a box, from three texts or from one
/// text for all axes. \throws InputError, naming the option, also if a length is not positive.
Vec3d lengths_of(const std::vector<std::string>& texts, const std::string& option);

}  // namespace macadam
