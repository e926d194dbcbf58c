// SPDX-License-Identifier: GPL-3.0-or-later
/// \file generalised_kelvin.hpp  A Maxwell unit in series with any number of Kelvin units, Eq. 13–17 (corrected).
///
/// Displacement x = f/k_m + ∫f/η_m dt + Σ x_l with η_l·dx_l/dt + k_l·x_l = f. The trapezoidal rule over one step gives
///   c·f(t+Δt) = Δx + Σ (1 − b_l/a_l)·x_l(t) − g·f(t),   x_l(t+Δt) = [b_l·x_l(t) + Δt/(2η_l)·(f(t+Δt) + f(t))]/a_l.
/// (The published Eq. 13 and 14 each carry a misprint.) Written in increments, because 1 − b_l/a_l is 1e-9…1e-6.
#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "macadam/laws/law.hpp"
#include "macadam/numeric.hpp"

namespace macadam::laws {

/// Generalised Kelvin; L = 0 is a Maxwell unit, L = 1 Burgers, C_m = ∞ has no dashpot in series.
struct GeneralisedKelvin {
  static constexpr const char* name = "generalised_kelvin";
  static constexpr int max_units = 16;
  double E_m = 0;                                        ///< Maxwell spring [Pa], δ included
  double C_m = std::numeric_limits<double>::infinity();  ///< Maxwell dashpot [Pa·s], may be infinite
  std::vector<double> E;                                 ///< Kelvin springs [Pa], at most max_units
  std::vector<double> C;                                 ///< Kelvin dashpots [Pa·s], as many
  double alpha = 0;                                      ///< shear over normal stiffness

  int units() const { return static_cast<int>(E.size()); }
  double instantaneous() const { return E_m; }

  /// 1/k*(ω) = 1/k_m + 1/(iω·η_m) + Σ 1/(k_l + iω·η_l)
  std::complex<double> stiffness(double omega) const {
    const std::complex<double> i(0, 1);
    std::complex<double> compliance = 1 / E_m;
    if (std::isfinite(C_m)) compliance += 1.0 / (i * omega * C_m);
    for (int l = 0; l < units(); ++l) compliance += unit_compliance(l, omega);
    return 1.0 / compliance;
  }
  /// x_l/f = 1/(k_l + iω·η_l)
  std::complex<double> unit_compliance(int l, double omega) const {
    const auto unit = static_cast<std::size_t>(l);
    return 1.0 / std::complex<double>(E[unit], omega * C[unit]);
  }

  template <class R>
  struct Step {
    static constexpr bool memoryless = false;
    R inv_c;                  ///< 1/c                          [Pa]
    R relax;                  ///< (c + g)/c                    [1]
    R recover[max_units];     ///< 1 − b_l/a_l                  [1]
    R compliance[max_units];  ///< Δt/(2·a_l·η_l)               [1/Pa]
    int n;
    MACADAM_HD int units() const { return n; }

    template <int L, class S, class Units>
    MACADAM_HD S advance(S f, S dx, Units&& x) const {
      const int m = L >= 0 ? L : n;
      S drive = dx;
      for (int l = 0; l < m; ++l) drive += S(recover[l]) * x(l);
      const S f_new = f + (S(inv_c) * drive - S(relax) * f);  // Eq. 13, corrected
      const S sum = f_new + f;
      for (int l = 0; l < m; ++l) x(l) += S(compliance[l]) * sum - S(recover[l]) * x(l);  // Eq. 14, corrected
      return f_new;
    }
  };

  template <class R>
  Step<R> step(double dt) const {  // Eq. 15
    Step<R> out{};
    out.n = units();
    double sum = 0;
    for (int l = 0; l < out.n; ++l) {
      const double a = 1 + E[l] * dt / (2 * C[l]);
      out.recover[l] = static_cast<R>(E[l] * dt / C[l] / a);  // a − b = k·Δt/η: no subtraction
      out.compliance[l] = static_cast<R>(dt / (2 * a * C[l]));
      sum += dt / (2 * a * C[l]);
    }
    if (std::isfinite(C_m)) sum += dt / (2 * C_m);
    const double inv_c = E_m / (1 + E_m * sum);  // exactly E_m where nothing flows
    out.inv_c = static_cast<R>(inv_c);
    out.relax = static_cast<R>(2 * sum * inv_c);
    return out;
  }
};

}  // namespace macadam::laws
