// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fragments.hpp  Splits the aggregate into fragments by a watershed of the distance from its surface. A fragment
/// surrounds a local maximum of the distance. Later steps decide which fragments form one grain.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// A face between two fragments, as a sum over the pairs of adjacent voxels on both sides.
struct Face {
  std::uint32_t a = 0, b = 0;  ///< numbers of the fragments, from 1; a < b
  double neck = 0;             ///< largest distance from the surface on the face [m]
  double grey = 0;             ///< sum over the pairs of the smaller grey value
  double area = 0;             ///< number of pairs
  Vec3d middle{};              ///< sum of the positions of the pairs [m]
};

/// The fragments of a scan and the faces between them.
struct Fragments {
  Image<std::uint32_t> labels;  ///< number of the fragment; 0: none
  std::vector<double> radius;   ///< radius of the largest inscribed sphere of each fragment [m]; entry 0 is unused
  std::vector<Face> faces;
};

/// Adds voxels in the order of decreasing distance from the surface. A voxel without a labelled neighbour starts a
/// basin; any other voxel joins the basin of its neighbour with the largest distance. Let d be the distance of a voxel
/// at which two basins meet, and m the smaller one of the two basins' largest distances. The basins are merged if d is
/// above `ratio`·m or less than half a voxel below m. The criterion is relative because with an absolute depth the
/// number of grains would depend on the depth chosen.
Fragments flood(const Image<float>& distance, const Image<float>& grey, double ratio);

}  // namespace macadam::ct
