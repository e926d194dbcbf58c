// SPDX-License-Identifier: GPL-3.0-or-later
/// \file voxelise.hpp  Computes which fraction of each voxel a body fills.
#pragma once

#include "macadam/ct.hpp"
#include "macadam/shape.hpp"

namespace macadam::ct {

/// The part of a specimen that remains after sawing: a box, or the upright cylinder inscribed in it.
struct SawnCore {
  Vec3d low{}, high{};  ///< corners of the box [m]
  bool cylinder = false;

  /// Whether the vertical line through (x, y) passes through the core.
  bool holds(double x, double y) const;
};

/// Filled fractions of the voxels in a part of a grid.
struct Coverage {
  std::array<std::int64_t, 3> begin{}, end{};  ///< range of voxels of the grid
  std::vector<float> share;                    ///< filled fraction, 0 to 1; x runs fastest
  double volume = 0;                           ///< filled volume of all voxels [m³]
  Vec3d centroid{};                            ///< centroid of the filled volume [m]

  std::size_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(i - begin[0] +
                                    (end[0] - begin[0]) * (j - begin[1] + (end[1] - begin[1]) * (k - begin[2])));
  }
};

/// A body: a closed surface, a sphere, or, with neither, all of the space.
struct Body {
  const Surface* surface = nullptr;
  Vec3d centre{};     ///< centre of the sphere [m]
  double radius = 0;  ///< radius of the sphere [m]
};

/// Computes which fraction of each voxel of `grid` the body fills within the core. Each voxel is crossed by `samples`²
/// vertical columns; along the columns the lengths are exact.
Coverage cover(const Body& body, const SawnCore& core, const Image<float>& grid, int samples);

}  // namespace macadam::ct
