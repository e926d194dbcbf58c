// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_files.hpp  Which files are surfaces.
#pragma once

#include <filesystem>
#include <vector>

namespace macadam {

/// Whether the ending is one that read_surface() knows.
bool is_surface_file(const std::filesystem::path& file);

/// The surfaces' files of a folder, by name.
/// \throws InputError where there is none.
std::vector<std::filesystem::path> surface_files_in(const std::filesystem::path& folder);

}  // namespace macadam
