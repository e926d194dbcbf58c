// SPDX-License-Identifier: GPL-3.0-or-later
/// \file slice_names.hpp  Names of files that are slices.
#pragma once

#include <filesystem>
#include <vector>

namespace macadam::ct {

/// Names whose last numbers rise by equal steps are those of a whole stack. \throws InputError naming the first two
/// between which one is missing. Names without numbers, or with equal ones, are not judged.
void check_slice_numbers(const std::vector<std::filesystem::path>& slices);

}  // namespace macadam::ct
