// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tiff_directories.hpp  The chain of a TIFF file's directories.
#pragma once

#include <filesystem>

namespace macadam::ct {

/// Each directory names the place of the next: ITK's libtiff follows a chain that comes back to itself for ever.
/// It also takes memory for as many values as a tag counts, before it looks for their bytes, and ITK reads texts of
/// tags that libtiff does not know beyond their end. Of a volume ITK asks the first page alone how large a slice is and
/// what its voxels are, and of voxels that it does not know it says nothing. \throws InputError for such a chain, for
/// one that leaves the file, for tags with more values than the file has bytes, for such a text without a 0 at its end,
/// or a known text that is of another type, for more than one value a voxel, for voxels that are not of 8 or 16 bits as
/// whole numbers or of 32 as a float, and for pages that are not alike. What is no TIFF file at all is left to ITK.
void check_tiff_directories(const std::filesystem::path& file);

}  // namespace macadam::ct
