// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fragments.hpp  A watershed of the distance inside the aggregate: fragments, each around a place that is
/// farther from the surface than its surroundings, and the faces between them.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// A face between two fragments.
struct Face {
  std::uint32_t a = 0, b = 0;  ///< a < b, numbers from 1
  double neck = 0;             ///< largest distance on it [m]
  double grey = 0;             ///< Σ of the smaller grey of its voxels' pairs
  double area = 0;             ///< pairs of voxels
  Vec3d middle{};              ///< Σ of places [m]
};

struct Fragments {
  Image<std::uint32_t> labels;  ///< 0: none
  std::vector<double> radius;   ///< of the largest inscribed sphere [m], by number; that of 0 has no meaning
  std::vector<Face> faces;
};

/// Floods from the highest distances down. Two basins that meet are one where the distance there is above `ratio` of
/// the smaller one's highest, or within half a voxel of it: relative, because an absolute depth decides how many grains
/// a scan has.
Fragments flood(const Image<float>& distance, const Image<float>& grey, double ratio);

}  // namespace macadam::ct
