// SPDX-License-Identifier: GPL-3.0-or-later
/// \file nearest.hpp  Finds the known word that an unknown key, command or option probably meant, for error messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace macadam {

/// Returns the word in `known` that has the fewest edits from `word`. If several words have equally few, returns the
/// first of them. `known` has at least one word.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// Returns the number of edits between two words. An edit inserts, removes or replaces one letter, or exchanges two
/// neighbouring letters. Upper and lower case count as equal. Only the first 64 letters of each word are compared.
std::size_t letters_between(std::string_view a, std::string_view b);

/// Returns the text that follows "expected" in an error message about an unknown word: "seed (the nearest of box,
/// seed)" if one of the known words is near, otherwise "one of box, seed". A known word is near if it is the only known
/// word that begins with the unknown word, or if at most a third of the letters of the longer of both words differ. Two
/// neighbouring letters in the wrong order count once; case does not count. `known` has at least one word.
std::string expected_one_of(std::string_view word, const std::vector<std::string>& known);

}  // namespace macadam
