// SPDX-License-Identifier: GPL-3.0-or-later
/// \file slice_names.hpp  Orders the TIFF files of a folder as slices of one stack.
#pragma once

#include <filesystem>
#include <vector>

namespace macadam::ct {

/// Returns the TIFF files of a folder in the order of the numbers in their names. The files must form one complete
/// stack. Missing slices are not detected if no name has a number, or if several numbers count the slices. \throws
/// InputError that names the folder if it has no TIFF file, if a file has no number, if the text around its number
/// differs from most files, or if two files have the same number. If a slice is missing, the error names the two files
/// before and after it.
std::vector<std::filesystem::path> slices_in(const std::filesystem::path& folder);

}  // namespace macadam::ct
