// SPDX-License-Identifier: GPL-3.0-or-later
/// \file transfer.hpp  Makes coarser grids, and moves vectors between two grids.
#pragma once

#include "host/tools/ct/continuum/grid.hpp"

namespace macadam::continuum {

/// Returns the grid with edges twice as long. Its constants are averages over the elements in each of its elements. If
/// the number of layers is odd, the uppermost layer is not merged with another layer, so it has half the height of a
/// cube.
template <class T>
Grid<T> coarser(const Grid<T>& fine);

/// Interpolates the displacement of the grid coarser(fine) and adds it to the displacement of `fine`. S, T: float or
/// double.
template <class S, class T>
void add_interpolated(const Size& coarse, const Field<S>& from, const Grid<T>& fine, Field<T>& to);

/// Sums the forces of `fine` into the nodes of the grid coarser(fine): the transpose of add_interpolated().
template <class T>
void restrict_to(const Grid<T>& fine, const Field<T>& from, const Size& coarse, Field<T>& to);

}  // namespace macadam::continuum
