// SPDX-License-Identifier: GPL-3.0-or-later
/// \file void_spheres.hpp  Voids of an image as spheres.
#pragma once

#include "macadam/ct.hpp"
#include "macadam/specimen.hpp"

namespace macadam::ct {

/// Spheres in place of the connected voids of an image.
struct VoidSpheres {
  std::vector<VoidSphere> spheres;  ///< in the image's coordinates
  double volume = 0;                ///< of all voids that are large enough [m³]
  double left_out = 0;              ///< of those that are not [m³]
};

/// Voids by the voxels of `phases`, connected by their faces. Each becomes inscribed spheres, the largest first, none
/// with its centre in another, which are then grown alike to the void's volume; one below `least` [m] is left out.
VoidSpheres void_spheres(const Image<std::uint8_t>& phases, double least);

}  // namespace macadam::ct
