// SPDX-License-Identifier: GPL-3.0-or-later
/// \file imagej_stack.hpp  Reads stacks of ImageJ: TIFF files with one directory and a description that counts the
/// slices.
#pragma once

#include <memory>

#include "host/tools/ct/images/tiff_directories.hpp"

namespace macadam::ct {

/// Opens a TIFF file in which one directory is followed by several uncompressed slices, as ImageJ writes stacks above 4
/// GB. Returns a null pointer if the file has a directory for every slice.
/// \throws InputError if the description counts more slices than there are directories and the file cannot be such a
/// stack: several directories, compressed slices, or too few bytes.
std::unique_ptr<ImageSlices> open_imagej_stack(const std::filesystem::path& file, const TiffPages& pages);

}  // namespace macadam::ct
