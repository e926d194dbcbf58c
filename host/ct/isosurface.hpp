// SPDX-License-Identifier: GPL-3.0-or-later
/// \file isosurface.hpp  Surfaces of grey values.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// The closed surface where a field is 0, between its positive and its other values: the largest of its parts. Nodes
/// are the voxels' centres; values at the end of the field must not be positive. Every cube of eight nodes is taken as
/// six tetrahedra, whose surface is closed and without pinched points by construction. Empty where nothing is positive.
Surface isosurface(const Image<float>& field);

/// A surface of fewer facets.
struct Simplified {
  Surface surface;
  double error = 0;  ///< largest distance of the other's points from it [m]
};

/// A surface of about `facets` facets (CGAL, Lindstrom and Turk, who keep the volume), or of `most` where the points of
/// the other are farther away than `error` [m]. It may cut itself: check_surface() tells.
Simplified simplified(const Surface& surface, int facets, int most, double error);

}  // namespace macadam::ct
