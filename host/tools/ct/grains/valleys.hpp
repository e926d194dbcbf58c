// SPDX-License-Identifier: GPL-3.0-or-later
/// \file valleys.hpp  Moves the cuts between grains to where the scan shows mastic between them.
#pragma once

#include "host/tools/ct/grains/fragments.hpp"

namespace macadam::ct {

/// Returns the labels of the grains on the grid of the fragments; `grain` gives the grain of each fragment. The
/// watershed of distances cuts at the narrowest place of the aggregate. Two grains do not always touch there: a thin
/// edge of grain A along the side of grain B may be nearer to the middle of B, and then it is assigned to B. Therefore
/// voxels less than `depth` [m] below a cut or a surface are assigned again, each to the grain that is reached through
/// the least mastic (`grey` is 0 for mastic and 1 for aggregate). If no mastic is visible, a cut moves by about a voxel
/// at most. With a depth of 0 all cuts stay.
Image<std::uint32_t> cut_along_valleys(const Fragments& fragments, const std::vector<std::uint32_t>& grain,
                                       const Image<float>& grey, double depth);

}  // namespace macadam::ct
