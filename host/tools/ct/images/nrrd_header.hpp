// SPDX-License-Identifier: GPL-3.0-or-later
/// \file nrrd_header.hpp  Checks the header of an NRRD file before ITK reads it.
#pragma once

#include "host/tools/ct/images/header_lines.hpp"

namespace macadam::ct {

/// Checks an NRRD header and returns the file of the voxels and the unit of lengths (`space units` or `units`). The
/// check is needed because of four faults of ITK. ITK keeps only 32 bits of a size, but its NRRD reader allocates
/// memory for the full size. ITK waits for ever if a path is not a regular file. ITK passes file name patterns to
/// printf. ITK ignores units. \throws InputError that names the line.
HeaderFacts check_nrrd_header(const std::filesystem::path& file);

}  // namespace macadam::ct
