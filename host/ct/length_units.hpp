// SPDX-License-Identifier: GPL-3.0-or-later
/// \file length_units.hpp  Units of length as headers of images name them.
#pragma once

#include <optional>
#include <string_view>

namespace macadam::ct {

/// Returns metres per unit for "mm", "um", "microns", "micrometre" and the like, in capitals or small letters. Empty
/// for any other name.
std::optional<double> metres_of_unit(std::string_view name);

}  // namespace macadam::ct
