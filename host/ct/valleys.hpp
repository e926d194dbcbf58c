// SPDX-License-Identifier: GPL-3.0-or-later
/// \file valleys.hpp  Cuts between grains, moved to where the scan shows mastic between them.
#pragma once

#include "host/ct/fragments.hpp"

namespace macadam::ct {

/// The grains' labels on the grid of the fragments, `grain` by fragment. The watershed of distances cuts where grains
/// grow together least, which is not always where they touch: a thin edge of one grain along the side of another is
/// nearer to the other's middle, and falls to it. So what lies less than `depth` [m] below a cut or a surface is given
/// out anew, each voxel to the grain that is reached from it through the least mastic: `grey` is 0 for mastic and 1 for
/// aggregate. Where no mastic shows, cuts stay, to a voxel or so; with a
/// depth of 0 all do.
Image<std::uint32_t> cut_along_valleys(const Fragments& fragments, const std::vector<std::uint32_t>& grain,
                                       const Image<float>& grey, double depth);

}  // namespace macadam::ct
