// SPDX-License-Identifier: GPL-3.0-or-later
/// \file apply_row.hpp  Multiplies by K*(s) without a stored matrix: every particle sums the loads of its own contacts.
#pragma once

#include "host/harmonic/complex_lanes.hpp"
#include "kernels/harmonic/linear_system.hpp"

namespace macadam::harmonic {

/// Stiffness of each pair type for F solutions, its inverse for the laws of cells, and the factor `inertia` of the mass
/// matrix M in K* − inertia·M.
template <int F>
struct BlockStiffness {
  std::array<Factor<F>, pair_types> k{}, compliance{};
  std::array<double, pair_types> alpha{};
  Factor<F> inertia{};
  bool inert = true;  ///< whether no solution has inertia
};

/// Returns the pressure of a body's cell over 2μ, for all F solutions (host/harmonic/cell_pressure.hpp). The system
/// must have cells.
template <int F>
Lanes<F> pressure_of(const kernels::LinearSystem& system, const BlockStiffness<F>& stiffness, std::size_t body,
                     const LaneVector<F>& x);

/// Computes the six rows of (K* − inertia·M)·x that belong to one body, for all F solutions. `pressures`, [body], are
/// the results of pressure_of() if the system has cells; otherwise they are not read.
template <int F>
void apply_row(const kernels::LinearSystem& system, const BlockStiffness<F>& stiffness, std::size_t body,
               const LaneVector<F>& x, const LaneVector<F>& pressures, Lanes<F> (&out)[6]);

extern template Lanes<1> pressure_of<1>(const kernels::LinearSystem&, const BlockStiffness<1>&, std::size_t,
                                        const LaneVector<1>&);
extern template Lanes<4> pressure_of<4>(const kernels::LinearSystem&, const BlockStiffness<4>&, std::size_t,
                                        const LaneVector<4>&);

extern template void apply_row<1>(const kernels::LinearSystem&, const BlockStiffness<1>&, std::size_t,
                                  const LaneVector<1>&, const LaneVector<1>&, Lanes<1> (&)[6]);
extern template void apply_row<4>(const kernels::LinearSystem&, const BlockStiffness<4>&, std::size_t,
                                  const LaneVector<4>&, const LaneVector<4>&, Lanes<4> (&)[6]);

}  // namespace macadam::harmonic
