// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_files.hpp  Files of a shape and its spheres, and of a library of shapes.
#pragma once

#include <filesystem>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// The shape made as large as a sphere of this radius [m] is by its intermediate dimension.
/// \throws InputError for a radius that is not above 0.
Surface scaled_to(Surface surface, double circumscribed);

/// spheres.csv, spheres.obj (each sphere as a subdivided icosahedron: any viewer of meshes shows it) and shape.obj, in
/// metres. \throws RunError; InputError where another command is writing into the folder.
void write_filling(const std::filesystem::path& out, const Surface& surface, const MultiSphere& cluster);

/// Each shape as an OFF file. \throws InputError where the folder holds a shape that is none of them: a folder is a
/// library; RunError.
void write_shape_library(const std::filesystem::path& out, const std::vector<Surface>& shapes);

}  // namespace macadam
