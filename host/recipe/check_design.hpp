// SPDX-License-Identifier: GPL-3.0-or-later
/// \file check_design.hpp  Checks the numbers of a mix design one by one, before they are combined.
#pragma once

#include <string>

#include "macadam/recipe.hpp"

namespace macadam {

/// Formats a length for messages, for example `12.5 mm`.
std::string in_millimetres(double metres);
/// Formats a fraction as a percentage for messages, for example `5.2 %`.
std::string in_percent(double share);
/// Formats a density for messages, for example `2433.4 kg/m3`.
std::string in_kg_m3(double density);

/// Always throws an InputError about `key`. The error names `line` or, if that is 0, the line of `key` in the scene
/// file.
[[noreturn]] void refuse(const MixDesign& design, const std::string& key, const std::string& found,
                         const std::string& expected, int line = 0);

/// Checks everything that does not depend on volumes: the gradation curve, the cut, the envelope, the contents and the
/// densities. \throws InputError for the first fault.
void check(const MixDesign& design);

}  // namespace macadam
