// SPDX-License-Identifier: GPL-3.0-or-later
/// \file series_factors.hpp  Computes the factors by which rock in series with a contact (Contact::series) reduces the
/// change of its forces in a time step.
#pragma once

#include "macadam/laws/law.hpp"
#include "macadam/numeric.hpp"

namespace macadam::kernels {

/// Factors 1/(1 + r·k) and 1/(1 + r·α·k) by which rock in series reduces the change of f in a step (model (6.12)), for
/// the normal components of a contact (opening, bending) and for its shear components (slips, twist).
template <class T>
struct SeriesFactors {
  T normal, shear;

  /// `series`: compliance r of the rock [1/Pa]; `stiffness`: k, change of f per displacement [Pa].
  MACADAM_HD static SeriesFactors of(const T& series, const T& stiffness, const T& alpha) {
    const T weakened = series * stiffness;
    return {T(1) / (T(1) + weakened), T(1) / (T(1) + alpha * weakened)};
  }
  /// Returns the factor of one of the six components.
  MACADAM_HD const T& of_component(int c) const { return c < 3 ? normal : shear; }
};
/// The factors of a contact without rock in series.
template <>
struct SeriesFactors<laws::NoFactor> {
  laws::NoFactor normal, shear;
  MACADAM_HD laws::NoFactor of_component(int) const { return {}; }
};

}  // namespace macadam::kernels
