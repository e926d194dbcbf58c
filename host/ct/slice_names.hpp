// SPDX-License-Identifier: GPL-3.0-or-later
/// \file slice_names.hpp  Names of files that are slices.
#pragma once

#include <filesystem>
#include <vector>

namespace macadam::ct {

/// Returns the TIFF files of a folder in the order of the numbers in their names. They have to make one whole
/// stack. Gaps are not looked for if no name has a number, or if several numbers count the slices. \throws InputError
/// naming the folder if it has no TIFF file, a file without a number or with another text before it than most files
/// have, two files of the same number, and the first two files between which a slice is missing.
std::vector<std::filesystem::path> slices_in(const std::filesystem::path& folder);

}  // namespace macadam::ct
