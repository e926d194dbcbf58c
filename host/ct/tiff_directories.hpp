// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tiff_directories.hpp  The chain of a TIFF file's directories.
#pragma once

#include <filesystem>
#include <optional>

#include "host/ct/image_slices.hpp"

namespace macadam::ct {

/// Facts in the directories of a TIFF file.
struct TiffPages {
  std::int64_t pages = 0;              ///< directories, each of one slice; 0: the file is not a TIFF
  std::int64_t width = 0, height = 0;  ///< of a slice, in voxels
  VoxelType type{};
  bool big_endian = false;
  bool white_is_zero = false;        ///< PhotometricInterpretation 0: the grey values have to be inverted
  std::int64_t described = 0;        ///< number of slices in ImageJ's description; 0: it has no such number
  std::optional<std::uint64_t> raw;  ///< where the first slice begins [bytes], if it is one strip without compression
};

/// Looks at a TIFF file before ITK reads it, and returns the facts in its directories. ITK and its libtiff trust such
/// files too much: libtiff follows a chain of directories that comes back to itself for ever, and allocates memory for
/// the number of values that a tag claims before it looks for their bytes; ITK reads texts of unknown tags beyond their
/// end, takes the size and type of all slices from the first page, and is silent about voxels that it cannot read.
/// A file that is not a TIFF is left to ITK.
/// \throws InputError for such a chain, for one that leaves the file, for tags with more values than the file has
/// bytes, for a text without a 0 at its end, a known text of another type, colours, tiles, voxels other than whole
/// numbers of 8 or 16 bits or floats of 32, inverted floats, pages that differ, and stacks of ImageJ with several
/// channels or times.
TiffPages check_tiff_directories(const std::filesystem::path& file);

}  // namespace macadam::ct
