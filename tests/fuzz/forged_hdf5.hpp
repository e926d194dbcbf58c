// SPDX-License-Identifier: GPL-3.0-or-later
/// \file forged_hdf5.hpp  HDF5 files that are whole but hold what nobody expects: other types, counts without bytes,
/// links. HDF5 1.10 crashes on files that are damaged inside; those would show its defects, not ours.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace macadam::fuzz {

/// The bytes of a file that follows from a recipe of any bytes: datasets in these groups ("/": beside them), named by
/// one of `names`, with attributes of one of `attributes`.
std::string forged_hdf5(std::string_view recipe, const std::vector<std::string>& groups,
                        const std::vector<std::string>& names, const std::vector<std::string>& attributes);

}  // namespace macadam::fuzz
