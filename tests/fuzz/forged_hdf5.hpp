// SPDX-License-Identifier: GPL-3.0-or-later
/// \file forged_hdf5.hpp  Makes valid HDF5 files with unexpected content: other types, sizes without data, links. The
/// format itself is never damaged: HDF5 1.10 crashes on damaged files, so the fuzzer would find defects of HDF5 and not
/// of this program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace macadam::fuzz {

/// Returns the bytes of an HDF5 file that is built from a recipe of arbitrary bytes. The file has datasets in `groups`
/// ("/" is the root). The names of the datasets are from `names`, and the names of their attributes are from
/// `attributes`.
std::string forged_hdf5(std::string_view recipe, const std::vector<std::string>& groups,
                        const std::vector<std::string>& names, const std::vector<std::string>& attributes);

}  // namespace macadam::fuzz
