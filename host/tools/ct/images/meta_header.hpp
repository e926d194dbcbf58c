// SPDX-License-Identifier: GPL-3.0-or-later
/// \file meta_header.hpp  Checks the header of a MetaImage file before ITK reads it.
#pragma once

#include "host/tools/ct/images/header_lines.hpp"

namespace macadam::ct {

/// Checks a MetaImage header and returns the file of the voxels and the unit of lengths. The check is needed because
/// ITK's MetaIO accepts any number of dimensions, ends the program at a long comment, searches binary data for header
/// lines, and ignores DistanceUnits. \throws InputError that names the line.
HeaderFacts check_meta_header(const std::filesystem::path& file);

}  // namespace macadam::ct
