// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_increment.hpp  Computes forces and tangent stiffness of one contact in a quasi-static increment, and
/// moves them to the centres of the particles. CPU and devices (GPUs) call the same functions.
///
/// A contact has six relative displacements u (kernels/contact/contact_kinematics.hpp), and six forces F that do the
/// work F·du. Arrays of six by six numbers are derivatives of F with respect to u, row by row.
#pragma once

#include "kernels/contact/contact_kinematics.hpp"
#include "kernels/contact/series_factors.hpp"
#include "kernels/quasi_static/increment_law.hpp"
#include "macadam/laws/crack_tangent.hpp"

namespace macadam::kernels {

/// Computes the load on an end (0: A, 1: B) that does the work of the forces `f`; the contact exerts its negative. It
/// is Gᵀ·f, where G are the derivatives of u with respect to the motion of this end.
MACADAM_HD void load_on(const Placement<double>& c, const double* f, int end, double* out) {
  const double sign = end == 0 ? -1 : 1, arm = end == 0 ? c.arm_a : c.arm_b;
  const double n[3] = {c.n.x, c.n.y, c.n.z}, s[3] = {c.s.x, c.s.y, c.s.z}, t[3] = {c.t.x, c.t.y, c.t.z};
  for (int k = 0; k < 3; ++k) {
    out[k] = sign * (n[k] * f[0] + s[k] * f[3] + t[k] * f[4]);
    out[3 + k] = sign * (s[k] * f[2] - t[k] * f[1] + n[k] * f[5]) + arm * (s[k] * f[4] - t[k] * f[3]);
  }
}

/// Computes a column of G: the relative displacements that a unit motion of an end along `axis` (0…2: displacements,
/// 3…5: rotations) causes.
MACADAM_HD void motion_column(const Placement<double>& c, int end, int axis, double* u) {
  const double sign = end == 0 ? -1 : 1, arm = end == 0 ? c.arm_a : c.arm_b;
  const int k = axis < 3 ? axis : axis - 3;
  const double n = k == 0   ? c.n.x
                   : k == 1 ? c.n.y
                            : c.n.z,
               s = k == 0   ? c.s.x
                   : k == 1 ? c.s.y
                            : c.s.z,
               t = k == 0   ? c.t.x
                   : k == 1 ? c.t.y
                            : c.t.z;
  const bool turns = axis >= 3;
  u[0] = turns ? 0 : sign * n;
  u[1] = turns ? -sign * t : 0;
  u[2] = turns ? sign * s : 0;
  u[3] = turns ? -arm * t : sign * s;
  u[4] = turns ? arm * s : sign * t;
  u[5] = turns ? sign * n : 0;
}

/// Computes column `axis` of the block Gᵀ·k·G of two ends: the derivatives of the load on `end` with respect to a
/// motion of `far_end`. `k`: stiffness of the contact, [6][6].
MACADAM_HD void tangent_column(const Placement<double>& c, const double* k, int end, int far_end, int axis,
                               double (&out)[6]) {
  double column[6], v[6];
  motion_column(c, far_end, axis, column);
  for (int r = 0; r < 6; ++r) {
    v[r] = 0;
    for (int l = 0; l < 6; ++l) v[r] += k[6 * r + l] * column[l];
  }
  load_on(c, v, end, out);
}

/// Computes the six forces of a condensed contact with the densities f (model (7.1)). `m`: area moments over length.
MACADAM_HD void condensed_forces(const double* f, double alpha, const double* m, double* out) {
  out[0] = m[0] * f[0] + m[1] * f[1] + m[2] * f[2];
  out[1] = m[1] * f[0] + m[3] * f[1] + m[4] * f[2];
  out[2] = m[2] * f[0] + m[4] * f[1] + m[5] * f[2];
  out[3] = alpha * (m[0] * f[3] - m[2] * f[5]);
  out[4] = alpha * (m[0] * f[4] + m[1] * f[5]);
  out[5] = alpha * (-m[2] * f[3] + m[1] * f[4] + (m[3] + m[5]) * f[5]);
}

/// A condensed contact with a linear law.
struct LinearContact {
  double series;      ///< Contact::series [1/Pa]
  double moments[6];  ///< area moments over length
};

/// Computes the forces of a condensed contact. `base`: f at the end of the increment without motion.
MACADAM_HD void linear_forces(const IncrementLaw& law, const LinearContact& c, const double* base, const double* u,
                              double* force) {
  const auto factors = SeriesFactors<double>::of(c.series, law.stiffness(), law.alpha());
  const double k[2] = {law.stiffness() * factors.normal, law.stiffness() * factors.shear};
  double f[6];
  for (int i = 0; i < 6; ++i) f[i] = base[i] + k[i / 3] * u[i];
  condensed_forces(f, law.alpha(), c.moments, force);
}
/// Computes the stiffness of a condensed contact, [6][6].
MACADAM_HD void linear_stiffness(const IncrementLaw& law, const LinearContact& c, double* out) {
  const auto factors = SeriesFactors<double>::of(c.series, law.stiffness(), law.alpha());
  const double n = law.stiffness() * factors.normal, s = law.stiffness() * factors.shear * law.alpha();
  const double* m = c.moments;
  const double rows[36] = {n * m[0], n * m[1], n * m[2], 0,         0,        0,          //
                           n * m[1], n * m[3], n * m[4], 0,         0,        0,          //
                           n * m[2], n * m[4], n * m[5], 0,         0,        0,          //
                           0,        0,        0,        s * m[0],  0,        -s * m[2],  //
                           0,        0,        0,        0,         s * m[0], s * m[1],   //
                           0,        0,        0,        -s * m[2], s * m[1], s * (m[3] + m[5])};
  for (int i = 0; i < 36; ++i) out[i] = rows[i];
}

/// A point of a contact with cracks, at the beginning of an increment.
struct PointStart {
  double s, t, area;                ///< local coordinates [m], area [m²]
  double base[3];                   ///< stresses at the end of the increment without motion [Pa]
  laws::CrackOpenings<double> old;  ///< openings [m]
  /// Area over the area of all points that grew in the last increment; 0 if the point did not grow then.
  double part;
};

/// Sums over the points of a contact.
struct PointSums {
  double force[6] = {};
  double opening = 0;  ///< increase of openings, weighted by PointStart::part [m]
};
struct TangentSums {
  double stiffness[36] = {};
  double opening_rate[6] = {};  ///< derivatives of PointSums::opening with respect to u
};

/// Changes of the stresses of a point per opening and per slip, if its crack does not move [Pa/m].
struct PointStiffness {
  double normal, shear;

  /// `length`, `series`: Contact::length [m] and Contact::series [1/Pa].
  MACADAM_HD static PointStiffness of(const IncrementLaw& law, double length, double series) {
    const auto factors = SeriesFactors<double>::of(series, law.stiffness(), law.alpha());
    const double k = law.stiffness() / length;
    return {k * factors.normal, law.alpha() * k * factors.shear};
  }
};

/// Stresses of a point if its crack does not move in the increment [Pa].
struct PointTrial {
  double normal, shear[2];
  bool intact;  ///< whether the point was intact and stays below its strength without friction

  MACADAM_HD static PointTrial of(const IncrementLaw& law, const PointStiffness& k, const PointStart& p,
                                  const double* u) {
    PointTrial out;
    out.normal = p.base[0] + k.normal * (u[0] + p.s * u[1] + p.t * u[2]);
    out.shear[0] = p.base[1] + k.shear * (u[3] - p.t * u[5]);
    out.shear[1] = p.base[2] + k.shear * (u[4] + p.s * u[5]);
    const double open = (out.normal > 0 ? out.normal : 0) * law.over_strength, over_c0 = law.over_shear_strength;
    out.intact = !(p.old.largest > 0) &&
                 open * open + (out.shear[0] * out.shear[0] + out.shear[1] * out.shear[1]) * over_c0 * over_c0 <= 1;
    return out;
  }
};

/// Adds the stresses of a point, and the drag on its motion in the increment.
MACADAM_HD void add_stresses(const IncrementLaw& law, const PointStart& p, const PointTrial& trial,
                             const double* of_crack, double opening, PointSums& sums) {
  const double sigma[3] = {of_crack[0] + law.drag * (trial.normal - p.base[0]),
                           of_crack[1] + law.drag * (trial.shear[0] - p.base[1]),
                           of_crack[2] + law.drag * (trial.shear[1] - p.base[2])};
  sums.force[0] += p.area * sigma[0];
  sums.force[1] += p.area * p.s * sigma[0];
  sums.force[2] += p.area * p.t * sigma[0];
  sums.force[3] += p.area * sigma[1];
  sums.force[4] += p.area * sigma[2];
  sums.force[5] += p.area * (p.s * sigma[2] - p.t * sigma[1]);
  if (p.part > 0) sums.opening += p.part * (opening - p.old.opening);
}

/// Adds the forces of a point for the relative displacements `u` of its contact. Returns whether its crack grows.
MACADAM_HD bool add_point(const IncrementLaw& law, const PointStiffness& k, const PointStart& p, const double* u,
                          PointSums& sums) {
  const PointTrial trial = PointTrial::of(law, k, p, u);
  laws::CrackOpenings<double> w = p.old;
  double sigma[3] = {trial.normal, trial.shear[0], trial.shear[1]};
  if (!trial.intact) {
    const auto stress = law.advance.crack(trial.normal, trial.shear, k.normal, k.shear, w);
    sigma[0] = stress.normal, sigma[1] = stress.shear[0], sigma[2] = stress.shear[1];
  }
  add_stresses(law, p, trial, sigma, w.opening, sums);
  return w.largest > p.old.largest;
}

/// As add_point(), and adds the tangent stiffness.
MACADAM_HD bool add_point(const IncrementLaw& law, const PointStiffness& stiff, const PointStart& p, const double* u,
                          PointSums& sums, TangentSums& tangent) {
  const PointTrial trial = PointTrial::of(law, stiff, p, u);
  const double kappa = stiff.normal, kappa_s = stiff.shear, s = p.s, t = p.t;
  laws::CrackTangent out{{trial.normal, trial.shear[0], trial.shear[1]},
                         {{kappa, 0, 0}, {0, kappa_s, 0}, {0, 0, kappa_s}},
                         p.old,
                         laws::PointBranch::rests};
  if (!trial.intact) out = laws::CrackTangent::of(law.advance.crack, trial.normal, trial.shear, kappa, kappa_s, p.old);
  add_stresses(law, p, trial, out.stress, out.w.opening, sums);
  if (p.part > 0) {
    const double on_normal[3] = {1, s, t};
    double by[3];
    for (int k = 0; k < 3; ++k) by[k] = p.part * ((k == 0) - out.stiffness[0][k] / kappa);
    double(&rate)[6] = tangent.opening_rate;
    for (int k = 0; k < 3; ++k) rate[k] += by[0] * on_normal[k];
    rate[3] += by[1], rate[4] += by[2], rate[5] += s * by[2] - t * by[1];
  }
  for (int k = 0; k < 3; ++k) out.stiffness[k][k] += law.drag * (k == 0 ? kappa : kappa_s);
  // B·D·B with the rows (1, s, t, 0, 0, 0), (0, 0, 0, 1, 0, −t), (0, 0, 0, 0, 1, s) of B
  double columns[3][6];  // D·B
  for (int k = 0; k < 3; ++k) {
    const double* d = out.stiffness[k];
    const double row[6] = {d[0], d[0] * s, d[0] * t, d[1], d[2], d[2] * s - d[1] * t};
    for (int i = 0; i < 6; ++i) columns[k][i] = p.area * row[i];
  }
  double(&stiffness)[36] = tangent.stiffness;
  for (int i = 0; i < 6; ++i) {
    stiffness[i] += columns[0][i];
    stiffness[6 + i] += s * columns[0][i];
    stiffness[12 + i] += t * columns[0][i];
    stiffness[18 + i] += columns[1][i];
    stiffness[24 + i] += columns[2][i];
    stiffness[30 + i] += s * columns[2][i] - t * columns[1][i];
  }
  return out.branch == laws::PointBranch::grows;
}

}  // namespace macadam::kernels
