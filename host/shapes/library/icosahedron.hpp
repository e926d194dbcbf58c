// SPDX-License-Identifier: GPL-3.0-or-later
/// \file icosahedron.hpp  Makes geodesic spheres: each triangle of an icosahedron on the unit sphere is repeatedly
/// divided into four.
#pragma once

#include "macadam/shape.hpp"

namespace macadam {

/// Returns a sphere with 10·4^levels + 2 points on the unit sphere and 20·4^levels facets, counter-clockwise seen from
/// outside. Uses sums, products and square roots only, so that all machines give the same bits.
Surface geodesic_sphere(int levels);

}  // namespace macadam
