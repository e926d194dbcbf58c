// SPDX-License-Identifier: GPL-3.0-or-later
/// \file generalised_kelvin.hpp  Defines a Maxwell unit in series with any number of Kelvin units: Eq. 13–17, corrected
/// as docs/model.md, section 6, says.
///
/// Displacement x = f/k_m + ∫f/η_m dt + Σ x_l with η_l·dx_l/dt + k_l·x_l = f. The trapezoidal rule over one step gives
///   c·f(t+Δt) = Δx + Σ (1 − b_l/a_l)·x_l(t) − g·f(t),   x_l(t+Δt) = [b_l·x_l(t) + Δt/(2η_l)·(f(t+Δt) + f(t))]/a_l.
/// The code computes increments of f and x_l, because 1 − b_l/a_l is only 1e-9…1e-6 and would be lost in a sum with
/// larger numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "macadam/laws/law.hpp"
#include "macadam/numeric.hpp"

namespace macadam::laws {

/// Generalised Kelvin chain with L units. L = 0 is a Maxwell unit, L = 1 the Burgers model; C_m = ∞ means no dashpot in
/// series.
struct GeneralisedKelvin {
  static constexpr const char* name = "generalised_kelvin";
  static constexpr const char* cracked_name = "generalised_kelvin with crack";
  static constexpr int max_units = 16;
  double E_m = 0;                                        ///< Maxwell spring [Pa], δ included
  double C_m = std::numeric_limits<double>::infinity();  ///< Maxwell dashpot [Pa·s], may be infinite
  std::vector<double> E;                                 ///< Kelvin springs [Pa], at most max_units
  std::vector<double> C;                                 ///< Kelvin dashpots [Pa·s], one per spring
  double alpha = 0;                                      ///< shear over normal stiffness

  template <class F>
  void each_key(F&& f) {
    f("E_m", E_m, ValueKind::modulus, ValueNeed::required);
    f("C_m", C_m, ValueKind::viscosity, ValueNeed::may_be_infinite);
    f("E", E, ValueKind::modulus, ValueNeed::optional);
    f("C", C, ValueKind::viscosity, ValueNeed::optional);
  }
  std::optional<LawFault> fault() const {
    if (E.size() != C.size()) {
      return LawFault{"C",
                      std::to_string(C.size()) + " viscosities for the " + std::to_string(E.size()) + " moduli in E",
                      "the same number: one modulus and one viscosity per Kelvin unit"};
    }
    if (E.size() > static_cast<std::size_t>(max_units)) {
      return LawFault{"E", std::to_string(E.size()) + " Kelvin units", "at most " + std::to_string(max_units)};
    }
    return {};
  }
  int units() const { return static_cast<int>(E.size()); }
  double instantaneous() const { return E_m; }
  /// Returns min C/E over all units, including Maxwell's [s].
  double shortest_time() const {
    double out = C_m / E_m;
    for (std::size_t l = 0; l < E.size(); ++l) out = std::min(out, C[l] / E[l]);
    return out;
  }

  /// Returns k*(s), with 1/k*(s) = 1/k_m + 1/(s·η_m) + Σ 1/(k_l + s·η_l).
  std::complex<double> stiffness(std::complex<double> s) const {
    std::complex<double> compliance = 1 / E_m;
    if (std::isfinite(C_m)) compliance += 1.0 / (s * C_m);
    for (int l = 0; l < units(); ++l) compliance += unit_compliance(l, s);
    return 1.0 / compliance;
  }
  std::complex<double> stiffness(double) const = delete;  // deleted, so that ω cannot be passed instead of iω
  /// Returns x_l/f = 1/(k_l + s·η_l).
  std::complex<double> unit_compliance(int l, std::complex<double> s) const {
    const auto unit = static_cast<std::size_t>(l);
    return 1.0 / (E[unit] + s * C[unit]);
  }

  /// Returns the energy in the springs, f²/(2·E_m) + Σ ½·E_l·x_l² [Pa·m²].
  double stored(double f, const double* x) const {
    double out = f * f / (2 * E_m);
    for (std::size_t l = 0; l < E.size(); ++l) out += 0.5 * E[l] * x[l] * x[l];
    return out;
  }
  /// Returns the energy that the dashpots dissipate within `dt` [Pa·m²]: f is taken as linear in time, and the rate of
  /// each unit as the parabola with the rates (f − E_l·x_l)/C_l at both ends and the mean Δx_l/dt.
  double dissipated(double dt, double f_before, const double* x_before, double f, const double* x) const {
    if (!(dt > 0)) return 0;
    double out = std::isfinite(C_m) ? dt * (f_before * f_before + f_before * f + f * f) / (3 * C_m) : 0;
    const double per_dt = 1 / dt;
    for (std::size_t l = 0; l < E.size(); ++l) {
      const double per_c = 1 / C[l];
      const double first = (f_before - E[l] * x_before[l]) * per_c, last = (f - E[l] * x[l]) * per_c;
      const double mean = (x[l] - x_before[l]) * per_dt, rise = last - first, bend = first + last - 2 * mean;
      out += C[l] * dt * (mean * mean + rise * rise * (1.0 / 12) + bend * bend * (1.0 / 20));
    }
    return out;
  }

  /// Returns the relaxation, from the poles and residues of k*(s). Defined in host/spectrum/series.cpp. \throws
  /// InputError if the constants are not positive, or are beyond the range of a double.
  PronySeries prony() const;

  /// Calls f(name, ∂ln k/∂ln θ) for each parameter θ. k = 1/Σ c_j, so that ∂ln k/∂ln θ = −k·∂c/∂ln θ. Parameters: E_m,
  /// C_m if it is finite, E_1, C_1, E_2, …
  template <class F>
  void each_parameter(std::complex<double> s, F&& f) const {
    const std::complex<double> k = stiffness(s);
    f(std::string("E_m"), k / E_m);
    if (std::isfinite(C_m)) f(std::string("C_m"), k / (s * C_m));
    for (int l = 0; l < units(); ++l) {
      const auto unit = static_cast<std::size_t>(l);
      const std::complex<double> c = unit_compliance(l, s);
      f("E_" + std::to_string(l + 1), k * c * c * E[unit]);
      f("C_" + std::to_string(l + 1), k * c * c * s * C[unit]);
    }
  }

  /// Coefficients of one time step, see law.hpp; a_l, b_l, c and g as at the top of the file.
  template <class R>
  struct Step {
    static constexpr bool memoryless = false;
    R inv_c;                  ///< 1/c                          [Pa]
    R relax;                  ///< (c + g)/c                    [1]
    R recover[max_units];     ///< 1 − b_l/a_l                  [1]
    R compliance[max_units];  ///< Δt/(2·a_l·η_l)               [1/Pa]
    int n;

    template <int L, class S, class Units, class Factor = NoFactor>
    MACADAM_HD S advance(S f, S dx, Units&& x, const Factor& factor = {}) const {
      const S f_new = trial<L>(f, dx, x, factor);
      follow<L>(f_new + f, x);
      return f_new;  // NOLINT(performance-no-automatic-move): the numbers are in registers
    }
    template <int L, class S, class Units, class Factor = NoFactor>
    MACADAM_HD S trial(S f, S dx, Units&& x, const Factor& factor = {}) const {
      S stretched = dx;
      for (int l = 0; l < (L >= 0 ? L : n); ++l) stretched += S(recover[l]) * x(l);
      return f + factor * (S(inv_c) * stretched - S(relax) * f);  // model (6.6)
    }
    template <int L, class S, class Units>
    MACADAM_HD void follow(S sum, Units&& x) const {
      for (int l = 0; l < (L >= 0 ? L : n); ++l) x(l) += S(compliance[l]) * sum - S(recover[l]) * x(l);  // model (6.6)
    }
    MACADAM_HD R step_stiffness() const { return inv_c; }
  };

  template <class R>
  Step<R> step(double dt) const {  // Eq. 15
    Step<R> out{};
    out.n = units();
    double sum = 0;
    for (int l = 0; l < out.n; ++l) {
      const double a = 1 + E[l] * dt / (2 * C[l]);
      out.recover[l] = static_cast<R>(E[l] * dt / C[l] / a);  // (a − b)/a, computed as k·Δt/η/a without a subtraction
      out.compliance[l] = static_cast<R>(dt / (2 * a * C[l]));
      sum += dt / (2 * a * C[l]);
    }
    if (std::isfinite(C_m)) sum += dt / (2 * C_m);
    const double inv_c = E_m / (1 + E_m * sum);  // this form gives exactly E_m if no dashpot moves
    out.inv_c = static_cast<R>(inv_c);
    out.relax = static_cast<R>(2 * sum * inv_c);
    return out;
  }

  /// Coefficients of M steps taken as one block, in which f changes little. x_l at step k of the block is the sum of
  /// three parts: x_l at the beginning of the block, its decay since then, and its growth by f. The growth by f has two
  /// parts: one by f as it was at the beginning, and one by δf, the change of f since the beginning. The part by δf is
  /// exact; everything else is evaluated at the mean step (M − 1)/2. The exact part follows from s, the sum of δf' + δf
  /// over the steps so far, where δf' is the value after a step and δf the value before it:
  ///   δf(t+Δt) = δf(t) + rate·Δx + drift + follow·s − relax·δf(t)   (model (6.8)),
  ///   drift = rate·Σ r_l·x_l(mean step) − relax·f(beginning),   follow = rate·Σ r_l·Δt/(2·a_l·η_l).
  /// At the end x_l ← (1 − r_l)^M·x_l + gain_l·Σ(f' + f), with the same weight for all steps (model (6.9)). The error
  /// has a mean of zero over a block. It is of second order in M·Δt divided by the characteristic times of the load and
  /// of the units.
  struct Block {
    static constexpr int most_units = max_units;
    double rate, relax, follow;  ///< 1/c [Pa], (c + g)/c [1], [1]
    double recover[max_units];   ///< r_l [1]
    double ahead[max_units];  ///< (M − 1)·Δt/(2·a_l·η_l): growth of x_l until the block's middle, per f [1/Pa]
    double back[max_units];   ///< (M − 1)/2·r_l: fraction of x_l lost until the middle of the block [1]
    double lost[max_units];   ///< 1 − (1 − r_l)^M [1]
    double gain[max_units];   ///< Δt/(2·a_l·η_l) times the mean of (1 − r_l)^k over k < M [1/Pa]
    int n;

    /// Takes the coefficients of settle() from the block that ends.
    void settled_as(const Block& before) {
      std::copy(before.lost, before.lost + n, lost);
      std::copy(before.gain, before.gain + n, gain);
    }

    /// Returns the change of f per step without motion, from f and x_l at the beginning of the block.
    template <int L, class Units>
    MACADAM_HD double drift(double f, Units&& x) const {
      double past = 0;
      for (int l = 0; l < (L >= 0 ? L : n); ++l) past += recover[l] * (x(l) + (ahead[l] * f - back[l] * x(l)));
      return rate * past - relax * f;
    }
    /// Updates x_l at the end of a block. `sum`: Σ (f' + f) over its steps.
    template <int L, class Units>
    MACADAM_HD void settle(double sum, Units&& x) const {
      for (int l = 0; l < (L >= 0 ? L : n); ++l) x(l) += gain[l] * sum - lost[l] * x(l);
    }
  };
  Block block(double dt, int steps) const {
    const Step<double> one = step<double>(dt);
    Block out{};
    out.rate = one.inv_c;
    out.relax = one.relax;
    out.n = one.n;
    for (int l = 0; l < one.n; ++l) {
      const double r = one.recover[l];
      out.recover[l] = r;
      out.follow += out.rate * r * one.compliance[l];
      out.ahead[l] = (steps - 1) * one.compliance[l];
      out.back[l] = 0.5 * (steps - 1) * r;
      out.lost[l] = -std::expm1(steps * std::log1p(-r));
      out.gain[l] = one.compliance[l] * (r > 0 ? out.lost[l] / (steps * r) : 1.0);
    }
    return out;
  }
};

}  // namespace macadam::laws
