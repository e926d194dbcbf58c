// SPDX-License-Identifier: GPL-3.0-or-later
/// \file nearest.hpp  Finds the known word that an unknown key, command or option probably meant, for error messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace macadam {

/// Returns the known word (there is at least one) with the fewest edits from `word`; the first of several.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// Returns the number of edits between two words: letters inserted, removed or replaced, and neighbours exchanged.
/// Upper and lower case count as equal. Only the first 64 letters of each word are compared.
std::size_t letters_between(std::string_view a, std::string_view b);

/// Returns what a message expects in place of an unknown word: "seed (the nearest of box, seed)" if one of the known
/// words is near, otherwise "one of box, seed". A known word is near if at most a third of the letters of the longer
/// word differ (two neighbours in the wrong order count once, case does not count), or if it is the only one that
/// begins with the unknown word. `known` has at least one word.
std::string expected_one_of(std::string_view word, const std::vector<std::string>& known);

}  // namespace macadam
