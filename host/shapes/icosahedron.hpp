// SPDX-License-Identifier: GPL-3.0-or-later
/// \file icosahedron.hpp  The icosahedron, its triangles cut into four as often as asked, on the unit sphere.
#pragma once

#include "macadam/shape.hpp"

namespace macadam {

/// 10·4^levels + 2 points on the unit sphere and 20·4^levels facets, counter-clockwise seen from outside. Nothing but
/// sums, products and square roots: the same bits on every machine.
Surface geodesic_sphere(int levels);

}  // namespace macadam
