// SPDX-License-Identifier: GPL-3.0-or-later
/// \file region.hpp  Finds the part of a scan that is the specimen.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Returns a mask: 1 within the specimen, 0 outside. The specimen must stand upright in the scan. Its outline follows
/// from the fraction of material in each column of voxels, its ends from the fraction in each slice. \throws InputError
/// if nothing is brighter than the surroundings.
Image<std::uint8_t> find_region(const Image<float>& scan, ScanRegion kind);

/// Returns the mask of the voxels whose centres lie within the given region. \throws InputError if the region contains
/// no centre of a voxel.
Image<std::uint8_t> take_region(const Image<float>& scan, const GivenRegion& given);

}  // namespace macadam::ct
