// SPDX-License-Identifier: GPL-3.0-or-later
/// \file voxelise.hpp  How much of each voxel a body fills.
#pragma once

#include "macadam/ct.hpp"
#include "macadam/shape.hpp"

namespace macadam::ct {

/// What is left of a specimen after sawing: a box, or the upright cylinder in it.
struct SawnCore {
  Vec3d low{}, high{};  ///< corners of the box [m]
  bool cylinder = false;

  bool holds(double x, double y) const;
};

/// Shares of voxels that something fills: those of a part of a grid.
struct Coverage {
  std::array<std::int64_t, 3> begin{}, end{};  ///< voxels of the grid
  std::vector<float> share;                    ///< x runs fastest, 0…1
  double volume = 0;                           ///< of all [m³]
  Vec3d centroid{};                            ///< [m]

  std::size_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(i - begin[0] +
                                    (end[0] - begin[0]) * (j - begin[1] + (end[1] - begin[1]) * (k - begin[2])));
  }
};

/// A body: a closed surface, a sphere, or, of no points and no sphere, everything.
struct Body {
  const Surface* surface = nullptr;
  Vec3d centre{};     ///< of a sphere
  double radius = 0;  ///< of a sphere [m]
};

/// What a body fills of the voxels of a grid, within the core: exactly along z, by `samples`² columns a voxel across.
Coverage cover(const Body& body, const SawnCore& core, const Image<float>& grid, int samples);

}  // namespace macadam::ct
