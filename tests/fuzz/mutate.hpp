// SPDX-License-Identifier: GPL-3.0-or-later
/// \file mutate.hpp  Mutations that keep the form of a text: they change lines, and cells of lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace macadam::fuzz {

using Random = std::minstd_rand;

/// Returns a random number below `end`.
std::size_t below(Random& random, std::size_t end);

/// Returns the text after one mutation by libFuzzer, which does not know the form of the text. The result has at most
/// `most` bytes.
std::string changed_bytes(std::string text, std::size_t most);

/// Returns the text after a few changes of lines (removed, copied, exchanged) and cells (emptied, copied, inserted,
/// replaced by a word or number). `separators` are the characters between cells. `words` may replace cells, in addition
/// to numbers.
std::string changed_cells(std::string_view text, Random& random, std::string_view separators,
                          const std::vector<std::string>& words);

/// Implements LLVMFuzzerCustomMutator for a text of cells: a third of the calls change bytes, the remaining calls
/// change lines and cells.
std::size_t mutate_cells(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                         std::string_view separators, const std::vector<std::string>& words);

/// Copies the text to libFuzzer's buffer, cut to `most` bytes, and returns its size.
std::size_t give_back(const std::string& text, std::uint8_t* data, std::size_t most);

}  // namespace macadam::fuzz
