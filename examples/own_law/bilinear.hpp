// SPDX-License-Identifier: GPL-3.0-or-later
/// \file bilinear.hpp  Example of a nonlinear contact law: an elastic contact that is softer beyond a displacement x_0.
#pragma once

#include <cmath>
#include <limits>

#include "macadam/laws/law.hpp"
#include "macadam/numeric.hpp"

/// Force f = E·x up to |x| = x_0, with the slope E_2 beyond. The only state of the law is the displacement x.
struct Bilinear {
  static constexpr const char* name = "bilinear";
  // The law is not linear, so the points of a contact are stepped one by one and not as one condensed contact.
  static constexpr bool linear = false;
  static constexpr int only_units = 1;
  double E = 0, E_2 = 0;  ///< [Pa], E_2 ≤ E
  double x_0 = 0;         ///< [m]
  double alpha = 0;       ///< ratio of shear stiffness to normal stiffness

  int units() const { return 1; }
  double instantaneous() const { return E; }
  double shortest_time() const { return std::numeric_limits<double>::infinity(); }

  template <class R>
  struct Step {
    static constexpr bool memoryless = false;
    R E, E_2, x_0;
    /// Advances the state x by dx and returns the new f. It uses sums, products and abs() instead of branches, so that
    /// it also compiles if S is a packet of contacts.
    template <int L, class S, class Units>
    MACADAM_HD S advance(S, S dx, Units&& x) const {
      x(0) += dx;
      return value(S(x(0)));
    }
    template <class S>
    MACADAM_HD S value(const S& x) const {
      // if S is a packet, the compiler finds the abs() that belongs to the packet
      using std::abs;
      const S beyond = S(R(0.5)) * (abs(x - S(x_0)) - abs(x + S(x_0)));  // −x, limited to ±x_0
      return S(E_2) * x - S(E - E_2) * beyond;
    }
  };
  template <class R>
  Step<R> step(double) const {
    return {static_cast<R>(E), static_cast<R>(E_2), static_cast<R>(x_0)};
  }
};
