// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tiff_directories.hpp  Checks the directories of a TIFF file (one per page) before ITK reads it.
#pragma once

#include <filesystem>
#include <optional>

#include "host/tools/ct/images/image_slices.hpp"

namespace macadam::ct {

/// Facts in the directories of a TIFF file.
struct TiffPages {
  std::int64_t pages = 0;              ///< directories, each of one slice; 0: the file is not a TIFF
  std::int64_t width = 0, height = 0;  ///< size of a slice [voxels]
  VoxelType type{};
  bool big_endian = false;
  bool white_is_zero = false;        ///< PhotometricInterpretation 0: the grey values have to be inverted
  std::int64_t described = 0;        ///< number of slices in ImageJ's description; 0 if it has no such number
  std::optional<std::uint64_t> raw;  ///< byte at which the first slice begins, if it is one uncompressed strip
};

/// Checks a TIFF file before ITK reads it, and returns the facts in its directories. The check is needed because ITK
/// and its libtiff trust such files too much. If a chain of directories returns to itself, libtiff follows the chain
/// for ever. libtiff also allocates memory for as many values as a tag claims to have, before it checks that the file
/// holds these values. ITK reads texts of unknown tags beyond their end, takes the size and type of all slices from the
/// first page, and does not report voxels that it cannot read. A file that is not a TIFF is not checked; ITK reports
/// it.
/// \throws InputError for a chain of directories that returns to itself or points outside the file, tags with more
/// values than the file has bytes, a text without a final 0, a known text tag of another type, colours, tiles, voxels
/// other than whole numbers of 8 or 16 bits or floats of 32, inverted floats, pages that differ, and stacks of ImageJ
/// with several channels or times.
TiffPages check_tiff_directories(const std::filesystem::path& file);

}  // namespace macadam::ct
