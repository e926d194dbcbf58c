// SPDX-License-Identifier: GPL-3.0-or-later
/// \file itk_io.hpp  Chooses ITK's reader or writer for an image file. It includes ITK headers, so only the few files
/// that call ITK include it.
#pragma once

#include <itkImageIOBase.h>

#include <filesystem>

namespace macadam::ct {

inline constexpr double mm = 1e-3;  ///< unit of lengths in image files that name no unit [m]

/// Returns the ITK reader/writer for the format that the file name's ending names. \throws InputError for an unknown
/// ending.
itk::ImageIOBase::Pointer io_of(const std::filesystem::path& path);

}  // namespace macadam::ct
