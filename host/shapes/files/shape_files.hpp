// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_files.hpp  Writes the files of one shape and its filling spheres, and of a library of shapes.
#pragma once

#include <filesystem>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// Returns the shape, scaled so that its intermediate dimension is the diameter of a sphere of this radius [m].
/// \throws InputError if the radius is not above 0.
Surface scaled_to(Surface surface, double circumscribed);

/// Writes spheres.csv, spheres.obj and shape.obj, in metres. In spheres.obj every sphere is a subdivided icosahedron,
/// so that any viewer of meshes shows it. \throws RunError; InputError if another command is writing into the folder.
void write_filling(const std::filesystem::path& out, const Surface& surface, const MultiSphere& cluster);

/// Writes each shape as an OFF file. \throws RunError; InputError if the folder holds a shape that is not one of them,
/// because all shapes in a folder make one library.
void write_shape_library(const std::filesystem::path& out, const std::vector<Surface>& shapes);

}  // namespace macadam
