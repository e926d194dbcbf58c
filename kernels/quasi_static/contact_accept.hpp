// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_accept.hpp  Prepares the states of contacts for an increment, and advances them at its end with the
/// energies of the increment. CPU and devices (GPUs) call the same functions.
///
/// Number n of component k of a contact, or of a point with a crack, is state(k, n), a reference.
#pragma once

#include "kernels/quasi_static/contact_increment.hpp"

namespace macadam::kernels {

/// Sums over contacts at the end of an increment.
struct ContactEnergies {
  double elastic = 0, viscous = 0, crack = 0, friction = 0, crack_work = 0;  ///< [J]
  double opened = 0, growing = 0;  ///< of points that grew: sum of area times increase of opening [m³], and area [m²]
  double damping = 0;              ///< work of the drag [J]
  double drag = 0;                 ///< at the end: sum of area times stress² of the drag over the stiffness [J]

  MACADAM_HD ContactEnergies& operator+=(const ContactEnergies& o) {
    elastic += o.elastic, viscous += o.viscous, crack += o.crack, friction += o.friction, crack_work += o.crack_work;
    opened += o.opened, growing += o.growing, damping += o.damping, drag += o.drag;
    return *this;
  }
};

/// Computes `base` of linear_forces().
template <class State>
MACADAM_HD void prepare_linear(const IncrementLaw& law, double series, State&& state, double* base) {
  const auto factors = SeriesFactors<double>::of(series, law.stiffness(), law.alpha());
  for (int k = 0; k < 6; ++k) {
    base[k] = law.advance.chain.template trial<-1>(
        double(state(k, 0)), 0.0, [&](int u) -> double& { return state(k, 1 + u); }, factors.of_component(k));
  }
}

/// Computes PointStart::base.
template <class State>
MACADAM_HD void prepare_point(const IncrementLaw& law, double length, double series, State&& state, double* base) {
  const double over_d = 1 / length;
  const auto factors = SeriesFactors<double>::of(series, law.stiffness(), law.alpha());
  for (int k = 0; k < 3; ++k) {
    const double f = law.advance.chain.template trial<-1>(
        double(state(k, 0)), 0.0, [&](int u) -> double& { return state(k, IncrementLaw::first_unit + u); },
        k == 0 ? factors.normal : factors.shear);
    base[k] = (k == 0 ? over_d : over_d * law.alpha()) * f;
  }
}

/// Advances the states of a condensed contact. Returns its energies: viscous of the increment, others at its end.
template <class State>
MACADAM_HD ContactEnergies accept_linear(const IncrementLaw& law, const LinearContact& c, const double* base,
                                         const double* u, State&& state) {
  const double alpha = law.alpha();
  const auto factors = SeriesFactors<double>::of(c.series, law.stiffness(), alpha);
  double f[6], mean[6], changes[IncrementLaw::max_units][6];
  for (int k = 0; k < 6; ++k) {
    const double old = state(k, 0);
    f[k] = base[k] + law.stiffness() * factors.of_component(k) * u[k];
    mean[k] = 0.5 * (f[k] + old);
    for (int n = 0; n < law.units; ++n) changes[n][k] = state(k, 1 + n);
    law.advance.chain.template follow<-1>(f[k] + old, [&](int n) -> double& { return state(k, 1 + n); });
    for (int n = 0; n < law.units; ++n) changes[n][k] = state(k, 1 + n) - changes[n][k];
    state(k, 0) = f[k];
  }
  const auto product = [&](const double* x, const double* y) {
    double forces[6], out = 0;
    condensed_forces(y, alpha, c.moments, forces);
    for (int k = 0; k < 6; ++k) out += x[k] * forces[k];
    return out;
  };
  ContactEnergies out;
  out.elastic = 0.5 * product(f, f) / law.spring;
  if (c.series != 0) {  // rock takes r·f of the opening, and r·α·f of the slip
    double weighted[6];
    for (int k = 0; k < 6; ++k) weighted[k] = k < 3 ? f[k] : alpha * f[k];
    out.elastic += 0.5 * c.series * product(weighted, f);
  }
  if (std::isfinite(law.dashpot)) out.viscous += law.dt / law.dashpot * product(mean, mean);
  for (int n = 0; n < law.units; ++n) {
    double x[6];
    for (int k = 0; k < 6; ++k) x[k] = state(k, 1 + n);
    out.elastic += 0.5 * law.unit_spring[n] * product(x, x);
    out.viscous += law.unit_dashpot[n] / law.dt * product(changes[n], changes[n]);
  }
  return out;
}

/// Damage and energy of a crack.
struct CrackNumbers {
  double damage, energy;  ///< 1: separated; [J/m²]
};
/// Returns damage and energy of the crack of a point; the energy is that which damage has dissipated, and that which
/// the crack stores.
template <class State>
MACADAM_HD CrackNumbers crack_numbers(const IncrementLaw& law, State&& state, double slip) {
  CrackNumbers out{0, state(2, 2)};
  const double opening = state(0, 1), y = state(0, 2);
  if (!(y > 0)) return out;
  const auto& crack = law.advance.crack;
  double rate;
  const double t = crack.curve.stress(y, rate);
  out.damage = 1 - t / crack.curve.strength;
  out.energy += 0.5 * t / y * (opening * opening + crack.strengths * slip * slip);
  return out;
}

/// Advances the states of a point with a crack and adds its energies to `out`. `grows`: whether it grew in the last
/// evaluation.
template <class State>
MACADAM_HD void accept_point(const IncrementLaw& law, double length, double series, double s, double t, double area,
                             bool grows, const double* u, State&& state, ContactEnergies& out) {
  const double alpha = law.alpha();
  double before[3], old[3], units[3][IncrementLaw::max_units];
  for (int k = 0; k < 3; ++k) {
    before[k] = state(k, 0), old[k] = state(k, 1);
    for (int n = 0; n < law.units; ++n) units[k][n] = state(k, IncrementLaw::first_unit + n);
  }
  const double dx[3] = {u[0] + s * u[1] + t * u[2], u[3] - t * u[5], u[4] + s * u[5]};
  law.advance.template advance_point<-1>(dx, length, state, SeriesFactors<double>::of(series, law.stiffness(), alpha));
  for (int k = 0; k < 3; ++k) {
    const double now = state(k, 0), weight = (k == 0 ? 1 : alpha) * area / length, mean = 0.5 * (now + before[k]);
    double elastic = 0.5 * now * now * (1 / law.spring + (k == 0 ? 1 : alpha) * series), viscous = 0;
    if (std::isfinite(law.dashpot)) viscous += law.dt / law.dashpot * mean * mean;
    for (int n = 0; n < law.units; ++n) {
      const double x = state(k, IncrementLaw::first_unit + n), change = x - units[k][n];
      elastic += 0.5 * law.unit_spring[n] * x * x;
      viscous += law.unit_dashpot[n] / law.dt * change * change;
    }
    out.elastic += weight * elastic;
    out.viscous += weight * viscous;
    out.crack_work += weight * mean * (state(k, 1) - old[k]);
  }
  if (grows) out.opened += area * (state(0, 1) - old[0]), out.growing += area;
  const double slip = hypot(double(state(1, 1)), double(state(2, 1)));
  out.crack += area * crack_numbers(law, state, slip).energy;
  out.friction += area * state(1, 2);
}

/// Adds the work of the drag on a point in the increment by the trapezoidal rule. `before`: stress of the drag at the
/// end of the last increment, normal and two shear components, which becomes that of this one [Pa].
template <class Stress>
MACADAM_HD void accept_drag(const IncrementLaw& law, const PointStiffness& stiffness, double s, double t, double area,
                            const double* u, Stress&& before, ContactEnergies& out) {
  const double dx[3] = {u[0] + s * u[1] + t * u[2], u[3] - t * u[5], u[4] + s * u[5]};
  for (int k = 0; k < 3; ++k) {
    const double kappa = k == 0 ? stiffness.normal : stiffness.shear, now = law.drag * kappa * dx[k];
    out.damping += 0.5 * area * (now + before(k)) * dx[k];
    out.drag += area * now * now / kappa;
    before(k) = now;
  }
}

}  // namespace macadam::kernels
