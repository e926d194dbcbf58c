// SPDX-License-Identifier: GPL-3.0-or-later
/// \file brittle_bond.hpp  Defines an elastic bond that breaks permanently, model (6.10) and (6.11).
#pragma once

#include <limits>

#include "macadam/laws/law.hpp"
#include "macadam/numeric.hpp"

namespace macadam::laws {

/// f = E·x in all directions, until at a contact point the normal stress f_n/d exceeds the tensile strength, or the
/// shear stress α·|f_s|/d exceeds the shear strength. After that, the point bears only compression: f_n = min(E·x_n,
/// 0).
struct BrittleBond {
  static constexpr const char* name = "brittle_bond";
  static constexpr bool linear = false;
  static constexpr int only_units = 1;
  double E = 0;                                                     ///< modulus [Pa], δ included
  double tensile_strength = 0;                                      ///< [Pa]
  double shear_strength = std::numeric_limits<double>::infinity();  ///< [Pa]
  double alpha = 0;                                                 ///< shear over normal stiffness

  template <class F>
  void each_key(F&& f) {
    f("E", E, ValueKind::modulus, ValueNeed::required);
    f("tensile_strength", tensile_strength, ValueKind::strength, ValueNeed::required);
    f("shear_strength", shear_strength, ValueKind::strength, ValueNeed::may_be_infinite);
  }
  int units() const { return only_units; }
  double instantaneous() const { return E; }
  double shortest_time() const { return std::numeric_limits<double>::infinity(); }
  /// Returns how a contact point broke, from its six numbers (Step::advance_point).
  static Break break_of(const double* state) { return static_cast<Break>(static_cast<int>(state[3])); }

  /// Coefficients of one time step, see law.hpp.
  template <class R>
  struct Step {
    static constexpr bool memoryless = false, coupled = true;
    R E, alpha, tensile_strength, shear_strength;
    /// The second number of component 0 is the opening [m]. The second numbers of components 1 and 2 are the Break: 0,
    /// 1 for tension, 2 for shear. A point whose two stresses exceed their strengths in the same step broke in tension.
    template <int L, class S, class State>
    MACADAM_HD void advance_point(const S (&dx)[3], S d, State&& state) const {
      state(0, 1) += dx[0];
      const S opening = state(0, 1), n = S(E) * opening;
      const S s = state(1, 0) + S(E) * dx[1], t = state(2, 0) + S(E) * dx[2];
      const S tension = S(tensile_strength) * d, shear = S(shear_strength) * d, square = S(alpha) * S(alpha);
      const S sheared = select(square * (s * s + t * t) > shear * shear, S(2), S(0)), before = state(1, 1);
      const S broken = select(before > S(0), before, select(n > tension, S(1), sheared));
      const auto gone = broken > S(0);
      state(0, 0) = select(gone, select(opening > S(0), S(0), n), n);
      state(1, 0) = select(gone, S(0), s);
      state(2, 0) = select(gone, S(0), t);
      state(1, 1) = state(2, 1) = broken;
    }
  };
  template <class R>
  Step<R> step(double) const {
    return {static_cast<R>(E), static_cast<R>(alpha), static_cast<R>(tensile_strength), static_cast<R>(shear_strength)};
  }
};

}  // namespace macadam::laws
