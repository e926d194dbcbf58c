// SPDX-License-Identifier: GPL-3.0-or-later
/// \file crack_tangent.hpp  Computes the stresses of a contact point with a crack in a quasi-static increment, and
/// their derivatives with respect to the displacements of the point: docs/quasi-static.md, equations (Q.4) to (Q.7).
#pragma once

#include <cmath>

#include "macadam/laws/crack_solve.hpp"

namespace macadam::laws {

/// What a contact point does in an increment.
enum class PointBranch : std::uint8_t { rests, unloads, grows };

/// Stresses of a contact point at the end of an increment, and their derivatives.
struct CrackTangent {
  double stress[3];         ///< σ, and τ along ŝ and t̂ [Pa]
  double stiffness[3][3];   ///< derivatives of the stresses with respect to opening and slips of the point [Pa/m]
  CrackOpenings<double> w;  ///< openings at the end of the increment
  PointBranch branch;

  /// Computes an increment. `normal`, `shear`: stresses if the crack did not move [Pa]; `kappa`, `kappa_s`: change of
  /// the normal stress per opening, and of the shear stress per slip [Pa/m]; `old`: openings at the beginning.
  template <int passes>
  MACADAM_HD static CrackTangent of(const CrackSolve<double, passes>& crack, double normal, const double (&shear)[2],
                                    double kappa, double kappa_s, const CrackOpenings<double>& old) {
    CrackTangent out{{}, {}, old, PointBranch::rests};
    const auto stresses = crack(normal, shear, kappa, kappa_s, out.w);
    out.stress[0] = stresses.normal, out.stress[1] = stresses.shear[0], out.stress[2] = stresses.shear[1];
    out.stiffness[0][0] = kappa, out.stiffness[1][1] = out.stiffness[2][2] = kappa_s;
    if (!(out.w.largest > 0)) return out;  // intact

    typename CrackSolve<double, passes>::template Closed<double> closed;
    closed.kappa = kappa, closed.kappa_s = kappa_s;
    const double normal_closed = normal + kappa * old.opening;
    closed.opens = normal_closed > 0 ? normal_closed : 0;
    closed.pressure = closed.opens - normal_closed;
    for (int k = 0; k < 2; ++k) {
      closed.slip[k] = old.slip[k];
      closed.shear[k] = shear[k] + kappa_s * old.slip[k];
    }
    double rate;
    const double y = out.w.largest, t = crack.curve.stress(y, rate);
    const auto sliding = crack.sliding_of(closed, y, t);
    const bool grows = y > old.largest;
    const bool is_shut = normal_closed < 0;
    if (is_shut && !grows && !(sliding.size > crack.friction(t) * closed.pressure)) return out;
    out.branch = grows ? PointBranch::grows : PointBranch::unloads;

    // Derivatives at constant y. m: direction of sliding; b: part of the shear stress T_R that the crack transfers
    const double a = kappa * y + t, b = crack.strengths * t / sliding.weight, mu = crack.friction(t);
    const double resisted = mu * closed.pressure, *m = sliding.along;
    const double turn = resisted * sliding.over_size;  // of T − R·m when T turns
    double cohesive[2];                                // T_R
    for (int k = 0; k < 2; ++k) cohesive[k] = closed.shear[k] - resisted * m[k];
    if (!is_shut) out.stiffness[0][0] = kappa * t / a;
    for (int k = 0; k < 2; ++k) {
      out.stiffness[1 + k][0] = is_shut ? -(1 - b) * mu * kappa * m[k] : 0;
      for (int l = 0; l < 2; ++l) {
        const double across = (k == l) - m[k] * m[l];
        out.stiffness[1 + k][1 + l] = kappa_s * (b * (k == l) + (1 - b) * turn * across);
      }
    }
    if (!grows || crack.curve.kind == Softening::brittle) return out;

    // Derivatives with respect to y, and of y
    const auto excess = crack.excess_of(closed, y, t, rate, sliding);
    if (!(excess.fall > 0)) return out;
    const double shear_part = crack.slip_weight * crack.slip_weight / (sliding.weight * sliding.weight);
    double of_y[3] = {closed.opens / (a * a) * kappa, 0, 0};
    if (is_shut) of_y[0] = shear_part * (cohesive[0] * m[0] + cohesive[1] * m[1]) * mu * kappa;
    for (int l = 0; l < 2; ++l) {
      for (int k = 0; k < 2; ++k) {
        const double across = (k == l) - m[k] * m[l];
        of_y[1 + l] += shear_part * kappa_s * cohesive[k] * ((k == l) - turn * across);
      }
    }
    const double turning = crack.strengths * (rate - t * sliding.over_y) * sliding.over_y;  // d(B/y)/dy
    const double along = m[0] * old.slip[0] + m[1] * old.slip[1];
    const double softening = rate * y - t;
    double by_y[3];
    by_y[0] = is_shut ? 0 : closed.opens * kappa * softening / (a * a);
    for (int k = 0; k < 2; ++k) {
      const double resists = crack.friction_fall * rate * closed.pressure * m[k] -
                             turn * turning * (old.slip[k] - along * m[k]);  // d(R·m)/dy
      by_y[1 + k] =
          crack.strengths * kappa_s * softening / (sliding.weight * sliding.weight) * cohesive[k] + (1 - b) * resists;
    }
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) out.stiffness[k][l] += by_y[k] * of_y[l] / excess.fall;
    }
    return out;
  }
};

}  // namespace macadam::laws
