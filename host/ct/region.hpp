// SPDX-License-Identifier: GPL-3.0-or-later
/// \file region.hpp  What of a scan is the specimen.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// 1 within the specimen, 0 outside. A specimen stands upright in the scan: its outline is looked for in the share of
/// material of every column of voxels, its ends in that of every slice. \throws InputError where there is none.
Image<std::uint8_t> find_region(const Image<float>& scan, ScanRegion kind);

/// The voxels whose centres lie within the region that was given. \throws InputError where there is none.
Image<std::uint8_t> take_region(const Image<float>& scan, const GivenRegion& given);

}  // namespace macadam::ct
