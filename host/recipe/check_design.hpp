// SPDX-License-Identifier: GPL-3.0-or-later
/// \file check_design.hpp  Checks the numbers of a mix design one by one, before they are combined.
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

/// \throws InputError at the line of `key` in the scene, or at `line` if it is not 0.
[[noreturn]] void refuse(const MixDesign& design, const std::string& key, const std::string& found,
                         const std::string& expected, int line = 0);

/// Checks everything that does not depend on volumes: the gradation curve, the cut, the envelope, the contents and the
/// densities. \throws InputError for the first fault.
void check(const MixDesign& design);

}  // namespace macadam
