// SPDX-License-Identifier: GPL-3.0-or-later
/// \file compression.hpp  Computes modulus and Poisson's ratio of a specimen between two frictionless platens.
#pragma once

#include <functional>

#include "host/tools/ct/continuum/grid.hpp"

namespace macadam::continuum {

/// Result of a uniaxial test.
struct Compression {
  Complex modulus;  ///< axial stress over axial strain, in units of the grid's constants
  Complex poisson;  ///< minus the lateral strain between the free sides over the axial strain
  int iterations = 0;
  double residual = 0;  ///< norm of the last residual over the norm of the first
};

/// Is called before each iteration with the residual, divided by the first residual. An exception ends the solution.
using Watch = std::function<void(double residual)>;

/// Solves K·u = 0: the top is displaced along z, and the sides are free. `area`: cross-section of the specimen, in
/// faces of elements. `tolerance`: the solver stops at this residual, divided by the residual of a strain along z
/// alone. `u`: the initial displacement, from a similar problem, or a field without nodes; replaced by the solution.
/// \throws RunError after 500 iterations, and if the solution is not a number.
Compression compress(const Grid<double>& grid, double area, double tolerance, Field<double>& u,
                     const Watch& watch = {});

/// Removes elements whose faces do not connect them with both platens: pieces in a void cannot carry a load.
/// Returns the number of removed elements. \throws InputError if no material connects the platens.
std::size_t remove_loose_pieces(Grid<double>& grid);

}  // namespace macadam::continuum
