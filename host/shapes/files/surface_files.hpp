// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_files.hpp  Chooses the format of surface files by their ending, and reads surfaces from bytes.
#pragma once

#include <filesystem>
#include <vector>

#include "host/shapes/files/surface_readers.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// The supported formats of surface files.
enum class SurfaceFormat : std::uint8_t { stl, off, ply, obj };

/// Returns the format that the file's ending stands for. \throws InputError for any other ending.
SurfaceFormat format_of(const std::filesystem::path& file);

/// Reads a surface from the bytes of a file: checks its numbers, scales the coordinates, divides polygons into
/// triangles, and joins equal points and seams. The surface has the name of the file, which messages show. \throws
/// InputError if the file is not valid.
Surface surface_in(const SurfaceFile& file, SurfaceFormat format, double scale);

/// Checks `scale`, in metres per unit of the file. \throws InputError if it is not a finite positive number.
void require_scale(const std::filesystem::path& file, double scale);

/// Returns whether read_surface() can read files with this ending.
bool is_surface_file(const std::filesystem::path& file);

/// Returns the surface that read_surface() would return if this surface had been written to `file`. Writes no file.
/// \throws InputError for an unknown ending, or if the format cannot hold the surface.
Surface read_back(const std::filesystem::path& file, const Surface& surface);

}  // namespace macadam
