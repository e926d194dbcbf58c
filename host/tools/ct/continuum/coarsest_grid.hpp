// SPDX-License-Identifier: GPL-3.0-or-later
/// \file coarsest_grid.hpp  Solves K·u = r on the coarsest grid of a multigrid cycle, by factors of the matrix.
#pragma once

#include <memory>

#include "host/tools/ct/continuum/grid.hpp"

namespace macadam::continuum {

/// The factors of the coarsest grid. Motions of the whole body that no boundary holds get a stiffness of 1e-6 of the
/// largest diagonal element, so that the matrix is regular; the solver removes these motions.
///
/// Its file is compiled without this machine's own instructions: with them Eigen would align memory differently than in
/// the rest of the library.
class CoarsestGrid {
 public:
  /// \throws RunError if the matrix cannot be factorised.
  explicit CoarsestGrid(const Grid<float>& grid);
  ~CoarsestGrid();
  /// Computes u from r.
  void solve(const Field<float>& r, Field<float>& u) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace macadam::continuum
