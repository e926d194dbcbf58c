// SPDX-License-Identifier: GPL-3.0-or-later
/// \file mutate.hpp  Changes that leave the form of a text: lines, and cells in lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace macadam::fuzz {

using Random = std::minstd_rand;

/// A number below `end`.
std::size_t below(Random& random, std::size_t end);

/// One change by libFuzzer's own means, which is blind to form; at most `most` bytes.
std::string changed_bytes(std::string text, std::size_t most);

/// A few changes of lines (taken out, doubled, exchanged, moved) and of cells (replaced by a word or number, emptied,
/// exchanged). `separators`: what stands between cells. `words`: what may stand in a cell, besides numbers.
std::string changed_cells(std::string_view text, Random& random, std::string_view separators,
                          const std::vector<std::string>& words);

/// The body of LLVMFuzzerCustomMutator for a text of cells: bytes change in some inputs, cells in the others.
std::size_t mutate_cells(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                         std::string_view separators, const std::vector<std::string>& words);

/// Puts a text where libFuzzer wants it, cut to what fits.
std::size_t give_back(const std::string& text, std::uint8_t* data, std::size_t most);

}  // namespace macadam::fuzz
