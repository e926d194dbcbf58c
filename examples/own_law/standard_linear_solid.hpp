// SPDX-License-Identifier: GPL-3.0-or-later
/// \file standard_linear_solid.hpp  Example of a linear contact law: a spring in parallel with a spring and a dashpot
/// in series.
#pragma once

#include <complex>
#include <string>

#include "macadam/laws/law.hpp"
#include "macadam/laws/prony_series.hpp"
#include "macadam/numeric.hpp"

/// Force f = E_inf·x + g. The part g = E_1·(x − y) acts on the dashpot, whose displacement is y: C_1·dy/dt = g. The
/// only state of the law is g.
struct StandardLinearSolid {
  static constexpr const char* name = "standard_linear_solid";
  static constexpr int only_units = 1;
  double E_inf = 0, E_1 = 0;  ///< [Pa]
  double C_1 = 0;             ///< [Pa·s]
  double alpha = 0;           ///< ratio of shear stiffness to normal stiffness

  int units() const { return 1; }
  double instantaneous() const { return E_inf + E_1; }
  double shortest_time() const { return C_1 / E_1; }
  std::complex<double> stiffness(std::complex<double> s) const { return E_inf + E_1 * s * C_1 / (E_1 + s * C_1); }
  /// Returns the stress after a sudden strain, E_inf + E_1·e^(−t·E_1/C_1). With this function the law can be used in
  /// every solution without time steps.
  macadam::PronySeries prony() const { return {E_inf, {{E_1, C_1 / E_1}}}; }

  template <class R>
  struct Step {
    static constexpr bool memoryless = false;
    R E_inf, gain, loss;
    template <int L, class S, class Units>
    MACADAM_HD S advance(S f, S dx, Units&& x) const {
      const S dg = S(gain) * dx - S(loss) * x(0);
      x(0) += dg;
      return f + (S(E_inf) * dx + dg);
    }
  };
  /// Returns the factors of one time step by the trapezoidal rule: dg = E_1·(dx − Δt·(g + dg/2)/C_1).
  template <class R>
  Step<R> step(double dt) const {
    const double a = 1 + E_1 * dt / (2 * C_1);
    return {static_cast<R>(E_inf), static_cast<R>(E_1 / a), static_cast<R>(E_1 * dt / C_1 / a)};
  }
};
