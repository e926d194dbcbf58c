// SPDX-License-Identifier: GPL-3.0-or-later
/// \file nearest.hpp  Which known word was meant: for messages about unknown keys, commands and options.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace macadam {

/// Returns what a message expects in place of an unknown word: "seed (the nearest of box, seed)" if one of the known
/// words is near, otherwise "one of box, seed". A known word is near if at most a third of the letters of the longer
/// word differ (two neighbours in the wrong order count once, case does not count), or if it is the only one that
/// begins with the unknown word. `known` has at least one word.
std::string expected_one_of(std::string_view word, const std::vector<std::string>& known);

}  // namespace macadam
