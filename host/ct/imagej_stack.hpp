// SPDX-License-Identifier: GPL-3.0-or-later
/// \file imagej_stack.hpp  Stacks of ImageJ: TIFF files whose description counts the slices.
#pragma once

#include <memory>

#include "host/ct/tiff_directories.hpp"

namespace macadam::ct {

/// Opens a TIFF file with one directory behind which several slices follow one another without compression, as ImageJ
/// writes stacks above 4 GB. Returns a null pointer for a file whose directories count all slices.
/// \throws InputError where the description counts more slices than there are directories, and the voxels of the others
/// do not follow those of the first.
std::unique_ptr<ImageSlices> open_imagej_stack(const std::filesystem::path& file, const TiffPages& pages);

}  // namespace macadam::ct
