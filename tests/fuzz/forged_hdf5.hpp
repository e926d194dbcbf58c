// SPDX-License-Identifier: GPL-3.0-or-later
/// \file forged_hdf5.hpp  Makes valid HDF5 files with unexpected content: other types, sizes without data, links. The
/// files are not damaged inside, because HDF5 1.10 crashes on damaged files; that would find its defects, not ours.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace macadam::fuzz {

/// Returns the bytes of an HDF5 file that is built from a recipe of arbitrary bytes. It has datasets in `groups` ("/"
/// is the root), with names from `names` and attributes from `attributes`.
std::string forged_hdf5(std::string_view recipe, const std::vector<std::string>& groups,
                        const std::vector<std::string>& names, const std::vector<std::string>& attributes);

}  // namespace macadam::fuzz
