// SPDX-License-Identifier: GPL-3.0-or-later
/// \file foreign_packing.hpp  Reads packings of spheres that other programs wrote, and makes specimens of one material
/// of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// Spheres in the coordinates of another program, in metres.
struct ForeignPacking {
  std::vector<Vec3d> centre;
  std::vector<double> radius;
  std::string format;  ///< for messages: "LAMMPS dump", "text with column names" or "text"
};

/// Reads a packing. `unit` is the length of the file's unit [m]. The content decides the format:
/// - a LAMMPS dump: its last snapshot, with the columns x, y, z (or xu, yu, zu) and radius (or diameter);
/// - text with the names of the columns in its first line, with or without `#`: x, y, z, and r, radius or diameter;
/// - text without names: the first four columns are x, y, z and the radius.
///
/// Columns are separated by commas, semicolons, tabs or spaces. Other columns, empty lines and other lines that begin
/// with # are ignored. The export of Yade (`export.text`) is such a text. \throws InputError with file and line for a
/// value that is not a finite number, a radius that is not positive, or columns that are missing; RunError if the file
/// cannot be read
ForeignPacking read_packing(const std::filesystem::path& file, double unit);

/// Returns the spheres, at least one, as a specimen of mastic whose domain is the smallest box around them or, for
/// `cylinder`, the smallest upright cylinder whose axis is in the middle of this box. The corner of the box becomes the
/// origin. `source` begins messages. \throws InputError as validate().
Specimen specimen_of(const ForeignPacking& packing, bool cylinder, const std::string& source);

}  // namespace macadam
