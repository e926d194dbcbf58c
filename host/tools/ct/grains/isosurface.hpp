// SPDX-License-Identifier: GPL-3.0-or-later
/// \file isosurface.hpp  Makes triangle surfaces from fields of grey values, and simplifies them.
#pragma once

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Returns the closed surface between the positive and the other values of a field, where the interpolated field is 0.
/// If the surface has several parts, returns the one with the largest volume; if no value is positive, an empty
/// surface. The nodes of the field are the voxels' centres; values at the ends of the field must not be positive. Uses
/// marching cubes, in a form whose surface is always closed and has no pinched points.
Surface isosurface(const Image<float>& field);

/// A surface with fewer facets.
struct Simplified {
  Surface surface;
  double error = 0;  ///< largest distance of the original surface's points from `surface` [m]
};

/// Simplifies `surface` to about `facets` facets. If the simplified surface is farther than `error` [m] from a point of
/// `surface`, simplifies `surface` to about `most` facets instead. Uses CGAL's edge collapse by Lindstrom and Turk,
/// which keeps the volume. The result may intersect itself; check_surface() reports that.
Simplified simplified(const Surface& surface, int facets, int most, double error);

}  // namespace macadam::ct
