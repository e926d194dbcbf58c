// SPDX-License-Identifier: GPL-3.0-or-later
/// \file length_units.hpp  Converts the names of length units in image headers to metres.
#pragma once

#include <optional>
#include <string_view>

namespace macadam::ct {

/// Returns metres per unit for "mm", "um", "microns", "micrometre" and similar names, in upper or lower case. Empty for
/// an unknown name.
std::optional<double> metres_of_unit(std::string_view name);

}  // namespace macadam::ct
