// SPDX-License-Identifier: GPL-3.0-or-later
/// \file nearest.hpp  Which known word was meant: for messages about unknown keys, commands and options.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace macadam {

/// The known word (there is at least one) from which the fewest letters differ; the first of several.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// Letters that differ between two words (Levenshtein), upper and lower case alike; of each word the first 64 count.
std::size_t letters_between(std::string_view a, std::string_view b);

}  // namespace macadam
