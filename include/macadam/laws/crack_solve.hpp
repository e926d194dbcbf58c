// SPDX-License-Identifier: GPL-3.0-or-later
/// \file crack_solve.hpp  Solves one step of a cohesive crack in series with a contact law, at one contact point:
/// docs/cracks.md, equations (C.7) to (C.12).
#pragma once

#include "macadam/laws/crack.hpp"

namespace macadam::laws {

/// Openings of the crack of one contact point.
template <class S>
struct CrackOpenings {
  S opening;  ///< w_n [m]
  S slip[2];  ///< w_s along ŝ and t̂ [m]
  S largest;  ///< y, the largest effective opening so far [m]; 0: intact
};

/// Stresses at the end of a step [Pa], and two more stresses from which energies are computed.
template <class S>
struct CrackStresses {
  S normal, shear[2];
  S friction[2];      ///< part of the shear stress that friction bears
  S cohesion_before;  ///< t(y) at the beginning of the step
};

/// Number of passes of Newton's method in a time step: the error is below 1e-13 if a stress changes by 0.01·f_t.
inline constexpr int passes_of_step = 4;
/// Largest number of passes in a quasi-static increment, in which stresses change more.
inline constexpr int passes_of_increment = 40;

/// Coefficients of a crack in precision R. Work that no lane of a packet needs is left out.
template <class R, int passes = passes_of_step>
struct CrackSolve {
  static constexpr bool branches = passes > passes_of_step;
  SofteningCurve<R> curve;
  R alpha;              ///< ratio of shear to normal stiffness of the law; 0: no shear stress
  R strengths;          ///< β_c·β_w
  R slip_weight;        ///< β_w
  R residual_friction;  ///< μ_r
  R friction_fall;      ///< (μ_0 − μ_r)/f_t [1/Pa]

  static CrackSolve of(const Crack& crack, double alpha) {
    const double fall = (crack.friction - crack.residual_friction) / crack.tensile_strength;
    return {
        SofteningCurve<R>::of(crack), R(alpha), R(crack.strength_ratio() * crack.slip_weight()), R(crack.slip_weight()),
        R(crack.residual_friction),   R(fall)};
  }

  /// Returns the stresses at the end of a step and updates the openings `w`. `normal`, `shear`: the stresses that the
  /// law would have if the crack did not move in this step [Pa]. `kappa`, `kappa_s`: change of the normal stress per
  /// opening, and of the shear stress per slip, in this step [Pa/m].
  template <class S>
  MACADAM_HD CrackStresses<S> operator()(const S& normal, const S (&shear)[2], const S& kappa, const S& kappa_s,
                                         CrackOpenings<S>& w) const {
    const S zero(0), one(1), y = w.largest;
    // Stresses if the crack were shut and its faces had not slipped: S_n and T of (C.7).
    Closed<S> closed;
    closed.kappa = kappa, closed.kappa_s = kappa_s;
    const S normal_closed = normal + kappa * w.opening;
    closed.opens = select(normal_closed > zero, normal_closed, zero);
    closed.pressure = closed.opens - normal_closed;
    for (int k = 0; k < 2; ++k) {
      closed.slip[k] = w.slip[k];
      closed.shear[k] = shear[k] + closed.kappa_s * w.slip[k];
    }

    // Shut faces whose shear stress without the cohesive part is below μ·N do not slide: (C.8).
    S rate;
    const S t_before = curve.stress(y, rate);
    const Sliding<S> sliding = sliding_of(closed, y, t_before);
    const auto rests = normal_closed < zero && !(sliding.size > friction(t_before) * closed.pressure);

    // Growth of the crack
    const Excess<S> now = excess_of(closed, y, t_before, rate, sliding);
    const auto grows = !rests && now.value > one;
    if (!any(grows || y > zero)) return {normal, {shear[0], shear[1]}, {zero, zero}, t_before};  // intact
    if (any(grows)) w.largest = select(grows, grown(closed, y, now), y);

    // Stresses and openings at the end of the step, (C.11) and (C.12)
    const S t = curve.stress(w.largest, rate);
    const Sliding<S> end = sliding_of(closed, w.largest, t);
    const S over_a = one / (kappa * w.largest + t), over_b = one / end.weight, resisted = friction(t) * closed.pressure;
    CrackStresses<S> out;
    out.cohesion_before = t_before;
    w.opening = w.largest * closed.opens * over_a;
    out.normal = select(normal_closed < zero, normal_closed, normal_closed * t * over_a);
    for (int k = 0; k < 2; ++k) {
      out.friction[k] = select(rests, end.size * end.along[k], resisted * end.along[k]);
      const S cohesive = closed.shear[k] - out.friction[k];  // T_R
      out.shear[k] = cohesive * (S(strengths) * t * over_b) + out.friction[k];
      w.slip[k] = select(rests, w.slip[k], w.largest * cohesive * over_b);
    }
    return out;
  }

 private:
  friend struct CrackTangent;

  /// The point with a shut crack whose faces have not slipped.
  template <class S>
  struct Closed {
    S kappa, kappa_s;  ///< change of stress per opening and per slip [Pa/m]
    S opens;           ///< ⟨S_n⟩ [Pa]
    S pressure;        ///< N = ⟨−S_n⟩ [Pa]
    S shear[2];        ///< T [Pa]
    S slip[2];         ///< w_s at the beginning of the step [m]
  };
  /// B(y) of (C.9), and the shear stress without the cohesive part, P of (C.8): its size [Pa] and direction.
  template <class S>
  struct Sliding {
    S weight, over_y, size, over_size, along[2];
  };
  /// g(y) of (C.9), and D of (C.10), for which dg/dy = −2·D.
  template <class S>
  struct Excess {
    S value, fall;
  };

  template <class S>
  MACADAM_HD S friction(const S& t) const {
    return S(residual_friction) + S(friction_fall) * t;
  }
  template <class S>
  MACADAM_HD Sliding<S> sliding_of(const Closed<S>& closed, const S& y, const S& t) const {
    using std::sqrt;
    const S zero(0), one(1);
    Sliding<S> out;
    out.weight = alpha > 0 ? closed.kappa_s * y + S(strengths) * t : one;
    out.over_y = select(y > zero, one / select(y > zero, y, one), zero);
    S p[2];
    for (int k = 0; k < 2; ++k) p[k] = closed.shear[k] - out.weight * (closed.slip[k] * out.over_y);
    out.size = sqrt(p[0] * p[0] + p[1] * p[1]);
    out.over_size = select(out.size > zero, one / select(out.size > zero, out.size, one), zero);
    for (int k = 0; k < 2; ++k) out.along[k] = p[k] * out.over_size;
    return out;
  }

  /// Returns g(y) and D. `t`, `rate`: the softening curve t(y) and its derivative at y.
  template <class S>
  MACADAM_HD Excess<S> excess_of(const Closed<S>& closed, const S& y, const S& t, const S& rate,
                                 const Sliding<S>& sliding) const {
    const S over_a = S(1) / (closed.kappa * y + t), over_b = S(1) / sliding.weight;
    const S resisted = friction(t) * closed.pressure;
    const S q[2] = {closed.shear[0] - resisted * sliding.along[0], closed.shear[1] - resisted * sliding.along[1]};
    const S normal = closed.opens * over_a, shear = S(slip_weight) * over_b;
    const S of_normal = normal * normal, square = shear * shear, of_shear = square * (q[0] * q[0] + q[1] * q[1]);
    // q changes with y because friction falls and because the direction of sliding turns
    const S turning = S(strengths) * (rate - t * sliding.over_y) * sliding.over_y;  // d(B/y)/dy
    const S along = sliding.along[0] * closed.slip[0] + sliding.along[1] * closed.slip[1];
    S change(0);
    for (int k = 0; k < 2; ++k) {
      const S turned = turning * sliding.over_size * (along * sliding.along[k] - closed.slip[k]);
      change += q[k] * (S(friction_fall) * rate * closed.pressure * sliding.along[k] + resisted * turned);
    }
    return {of_normal + of_shear, of_normal * over_a * (closed.kappa + rate) +
                                      of_shear * over_b * (closed.kappa_s + S(strengths) * rate) + square * change};
  }

  /// Returns y > y_old with g(y) = 1, for g(y_old) > 1, by Newton's method on g^(−1/2), which is concave where t(y) is
  /// straight. `now`: g at y_old.
  template <class S>
  MACADAM_HD S grown(const Closed<S>& closed, const S& y_old, Excess<S> now) const {
    using std::sqrt;
    const S zero(0), one(1);
    if (curve.kind == Softening::brittle) return separated(closed);
    S y = y_old;
    for (int pass = 0; pass < passes; ++pass) {
      if (pass > 0) {
        S rate;
        const S t = curve.stress(y, rate);
        now = excess_of(closed, y, t, rate, sliding_of(closed, y, t));
      }
      const auto regular = now.fall > zero;
      const S next = y + now.value * (sqrt(now.value) - one) / select(regular, now.fall, one);
      // Friction that falls may leave no solution near y: the point then separates.
      y = friction_fall > 0 ? select(regular, next, separated(closed)) : select(regular, next, y);
      y = select(y > y_old, y, y_old);
      if constexpr (branches) {
        // convergence is quadratic, so the pass from an error of 1e-8 has reached the last digit
        if (now.value < S(1 + 1e-8) && now.value > S(1 - 1e-8)) break;
      }
    }
    return y;
  }

  /// Returns the effective opening of a separated point: y with g(y) = 1 for t = 0.
  template <class S>
  MACADAM_HD S separated(const Closed<S>& closed) const {
    using std::sqrt;
    const S opening = closed.opens / closed.kappa;
    if (!(alpha > 0)) return opening;
    S square = opening * opening, size(0), p[2];
    for (int k = 0; k < 2; ++k) {
      p[k] = closed.shear[k] / closed.kappa_s - closed.slip[k];
      size += p[k] * p[k];
    }
    size = sqrt(size);
    const S slid = S(residual_friction) * closed.pressure / closed.kappa_s / select(size > S(0), size, S(1));
    for (int k = 0; k < 2; ++k) {
      const S slip = S(slip_weight) * (closed.slip[k] + (S(1) - slid) * p[k]);
      square += slip * slip;
    }
    return sqrt(square);
  }
};

}  // namespace macadam::laws
