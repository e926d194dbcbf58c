// SPDX-License-Identifier: GPL-3.0-or-later
/// \file nrrd_header.hpp  The header of an NRRD file, looked at before ITK reads it.
#pragma once

#include "host/ct/header_lines.hpp"

namespace macadam::ct {

/// ITK keeps 32 bits of a size, while its reader of NRRD takes memory for all of it, waits for ever for files that are
/// none, and hands patterns of file names to printf; it passes over units. Returns the file of the voxels and the unit
/// of lengths (`space units` or `units`). \throws InputError naming the line.
HeaderFacts check_nrrd_header(const std::filesystem::path& file);

}  // namespace macadam::ct
