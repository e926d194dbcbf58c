// SPDX-License-Identifier: GPL-3.0-or-later
/// \file check_design.hpp  What each number of a mix design must be, before any is put together with another.
#pragma once

#include <string>

#include "macadam/recipe.hpp"

namespace macadam {

/// `12.5 mm`, for messages.
std::string in_millimetres(double metres);
/// `5.2 %`, for messages.
std::string in_percent(double share);
/// `2433.4 kg/m3`, for messages.
std::string in_kg_m3(double density);

/// \throws InputError at the line of a key, or at `line` where it is given.
[[noreturn]] void refuse(const MixDesign& design, const std::string& key, const std::string& found,
                         const std::string& expected, int line = 0);

/// Checks everything that needs no volumes: the curve, the cut, the envelope, the contents and the densities.
/// \throws InputError.
void check(const MixDesign& design);

}  // namespace macadam
