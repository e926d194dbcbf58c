// SPDX-License-Identifier: GPL-3.0-or-later
/// \file elastic.hpp  Defines the linear elastic contact law, Eq. 9–12, model (6.1).
#pragma once

#include <complex>
#include <limits>
#include <string>

#include "macadam/laws/law.hpp"
#include "macadam/numeric.hpp"

namespace macadam::laws {

/// The law f = E·x.
struct Elastic {
  static constexpr const char* name = "elastic";
  static constexpr const char* cracked_name = "elastic with crack";
  static constexpr int max_units = 0;
  double E = 0;      ///< modulus [Pa], δ included
  double alpha = 0;  ///< shear over normal stiffness

  template <class F>
  void each_key(F&& f) {
    f("E", E, ValueKind::modulus, ValueNeed::required);
  }
  int units() const { return 0; }
  double instantaneous() const { return E; }
  double shortest_time() const { return std::numeric_limits<double>::infinity(); }
  std::complex<double> stiffness(std::complex<double>) const { return E; }
  std::complex<double> stiffness(double) const = delete;  // deleted, so that ω cannot be passed instead of iω
  std::complex<double> unit_compliance(int, std::complex<double>) const { return 0; }
  PronySeries prony() const { return {E, {}}; }
  double stored(double f, const double*) const { return f * f / (2 * E); }
  double dissipated(double, double, const double*, double, const double*) const { return 0; }
  template <class F>
  void each_parameter(std::complex<double>, F&& f) const {
    f(std::string("E"), std::complex<double>(1));
  }

  /// Coefficients of one time step, see law.hpp.
  template <class R>
  struct Step {
    static constexpr bool memoryless = true;
    R E;
    template <class S>
    MACADAM_HD S value(S x) const {
      return S(E) * x;
    }
    template <int L, class S, class Units, class Factor = NoFactor>
    MACADAM_HD S advance(S f, S dx, Units&& x, const Factor& factor = {}) const {
      return trial<L>(f, dx, x, factor);
    }
    template <int L, class S, class Units, class Factor = NoFactor>
    MACADAM_HD S trial(S f, S dx, Units&&, const Factor& factor = {}) const {
      return f + factor * (S(E) * dx);  // Eq. 9
    }
    template <int L, class S, class Units>
    MACADAM_HD void follow(S, Units&&) const {}
    MACADAM_HD R step_stiffness() const { return E; }
  };
  template <class R>
  Step<R> step(double) const {
    return {static_cast<R>(E)};
  }

  /// The coefficients of a block of steps. An elastic law has no states that change in time, so a block is as exact as
  /// single steps.
  struct Block {
    static constexpr int most_units = 0;
    double rate, relax, follow;
    void settled_as(const Block&) {}
    template <int L, class Units>
    MACADAM_HD double drift(double, Units&&) const {
      return 0;
    }
    template <int L, class Units>
    MACADAM_HD void settle(double, Units&&) const {}
  };
  Block block(double, int) const { return {E, 0, 0}; }
};

}  // namespace macadam::laws
