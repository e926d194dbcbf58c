// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_files.hpp  Which files are surfaces, and what becomes of a surface in one.
#pragma once

#include <filesystem>
#include <vector>

#include "host/shapes/surface_readers.hpp"
#include "macadam/shape.hpp"

namespace macadam {

enum class SurfaceFormat : std::uint8_t { stl, off, ply, obj };

/// The format by the ending.
/// \throws InputError for another ending.
SurfaceFormat format_of(const std::filesystem::path& file);

/// The surface in a file's bytes, checked and scaled; its name is the file's, as messages show it.
/// \throws InputError
Surface surface_in(const SurfaceFile& file, SurfaceFormat format, double scale);

/// \throws InputError for metres per unit of the file that make no sense.
void require_scale(const std::filesystem::path& file, double scale);

/// Whether the ending is one that read_surface() knows.
bool is_surface_file(const std::filesystem::path& file);

/// The surfaces' files of a folder, by name.
/// \throws InputError where there is none.
std::vector<std::filesystem::path> surface_files_in(const std::filesystem::path& folder);

/// The surface as read_surface() would have it from `file`, were it written there; nothing is.
/// \throws InputError for another ending, or where the format cannot hold the surface.
Surface read_back(const std::filesystem::path& file, const Surface& surface);

}  // namespace macadam
