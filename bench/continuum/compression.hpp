// SPDX-License-Identifier: GPL-3.0-or-later
/// \file compression.hpp  Computes modulus and Poisson's ratio of a prism between two frictionless platens.
#pragma once

#include "bench/continuum/grid.hpp"

namespace continuum {

/// Result of a uniaxial test.
struct Compression {
  Complex modulus;  ///< axial stress over axial strain, in units of the grid's constants
  Complex poisson;  ///< minus the mean lateral strain, divided by the axial strain
  int iterations = 0;
  double residual = 0;  ///< norm of the last residual over the norm of the first
};

/// Compresses the prism that consists of the first `x` × `y` columns of elements; all other elements are empty. The top
/// is displaced along z, and the sides are free. `tolerance`: largest accepted Compression::residual. \throws
/// std::runtime_error after 500 iterations.
Compression compress(const Grid<double>& grid, int x, int y, double tolerance);

}  // namespace continuum
