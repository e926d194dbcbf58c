// SPDX-License-Identifier: GPL-3.0-or-later
/// \file multigrid.hpp  Solves K·u = f approximately by one multigrid cycle: the preconditioner of the solver.
#pragma once

#include <memory>

#include "host/tools/ct/continuum/grid.hpp"

namespace macadam::continuum {

class CoarsestGrid;

/// A V-cycle in single precision. Levels are smoothed by Chebyshev polynomials of the matrix preconditioned by its
/// diagonal; the coarsest level has a direct solver. The cycle is a complex symmetric operator, as the
/// solver needs.
class Multigrid {
 public:
  explicit Multigrid(const Grid<double>& grid);
  ~Multigrid();
  /// Returns an approximation of K⁻¹·r.
  void apply(const Field<double>& r, Field<double>& out);

 private:
  struct Level;
  void cycle(std::size_t level);
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<CoarsestGrid> coarsest_;
};

}  // namespace macadam::continuum
