// SPDX-License-Identifier: GPL-3.0-or-later
/// \file itk_io.hpp  ITK's readers and writers of image files. For the few files that call them.
#pragma once

#include <itkImageIOBase.h>

#include <filesystem>

namespace macadam::ct {

inline constexpr double mm = 1e-3;  ///< what lengths in image files are in [m]

/// The one that the ending of a file asks for. \throws InputError.
itk::ImageIOBase::Pointer io_of(const std::filesystem::path& path);

}  // namespace macadam::ct
