// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scan.hpp  Reads a segmented scan, and averages blocks of its voxels. Needs no ITK.
#pragma once

#include <string>
#include <vector>

#include "host/tools/ct/continuum/phase_fractions.hpp"

namespace macadam::continuum {

/// A segmented scan: one phase per voxel of the scan.
struct Scan {
  Size size;
  double edge = 0;                   ///< of a voxel [m]
  std::vector<unsigned char> phase;  ///< 0 void, 1 mastic, 2 rock, 255 outside the specimen
  bool has_voids = true;             ///< false for an image of labels, which shows voids as mastic
};

/// Reads a MetaImage of `macadam ct segment`, packed or not: phases.mha, or labels.mha, in which every grain is rock
/// and the remainder is mastic. Cuts it to the box around the specimen. \throws InputError naming the file, the value
/// found and the value expected.
Scan read_scan(const std::string& file);

/// Removes layers at the top until their number is a multiple of `layers`. Returns the number of removed layers.
int cut_layers(Scan& scan, int layers);

/// Returns the fractions of cubes of `block` voxels along each axis. Layers at the top that fill no block are left out.
/// \throws InputError if no block fits into the height.
PhaseFractions of_blocks(const Scan& scan, int block);

/// Calls of_blocks() with the block whose edge is `voxel` [m]. \throws InputError for an edge that is not a multiple of
/// the scan's to 1e-3.
PhaseFractions of_scan(const Scan& scan, double voxel);

}  // namespace macadam::continuum
