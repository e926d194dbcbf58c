// SPDX-License-Identifier: GPL-3.0-or-later
/// \file meta_header.hpp  The header of a MetaImage file, looked at before ITK reads it.
#pragma once

#include "host/ct/header_lines.hpp"

namespace macadam::ct {

/// ITK's MetaIO counts to whatever number of dimensions a header names, ends the program at a long comment, and reads
/// on through any bytes for lines that are none; it passes over DistanceUnits. Returns the file of the voxels and the
/// unit of lengths. \throws InputError naming the line.
HeaderFacts check_meta_header(const std::filesystem::path& file);

}  // namespace macadam::ct
