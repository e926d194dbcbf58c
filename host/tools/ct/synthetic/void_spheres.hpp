// SPDX-License-Identifier: GPL-3.0-or-later
/// \file void_spheres.hpp  Replaces the voids of an image by spheres.
#pragma once

#include "macadam/ct.hpp"
#include "macadam/specimen.hpp"

namespace macadam::ct {

/// Spheres that replace the connected voids of an image.
struct VoidSpheres {
  std::vector<VoidSphere> spheres;  ///< centres in the image's coordinates
  double volume = 0;                ///< total volume of the voids that are large enough [m³]
  double left_out = 0;              ///< total volume of the voids that are too small [m³]
};

/// Replaces each void by spheres of the same total volume. A void is a set of void voxels of `phases` that are
/// connected by their faces. A nearly round void becomes one sphere. Any other void becomes several inscribed spheres,
/// the largest first, none with its centre inside another; their radii are then multiplied by one factor to match the
/// void's volume. A void smaller than a sphere of radius `least` [m] is left out.
VoidSpheres void_spheres(const Image<std::uint8_t>& phases, double least);

}  // namespace macadam::ct
