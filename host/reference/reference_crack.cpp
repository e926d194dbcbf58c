// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_crack.cpp  Solves the equations of a cohesive crack (docs/cracks.md, (C.1) to (C.6)) by bisection.
#include "host/reference/reference_crack.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <fmt/format.h>

#include "macadam/error.hpp"

namespace macadam::reference {
namespace {

using Eigen::Vector2d;
using laws::Crack;
using laws::Softening;

/// \throws InputError naming the pair and the parameter of the crack, if `good` is false.
void require_crack(bool good, const std::string& pair, const char* what, double found, const char* expected) {
  if (!good) throw InputError("crack of pair " + pair, 0, what, fmt::format("{}", found), expected);
}

/// Returns β_c and β_w of (C.2) and (C.3).
double strength_ratio(const Crack& crack) { return crack.shear_strength / crack.tensile_strength; }
double slip_weight(const Crack& crack) {
  if (crack.softening == Softening::brittle) return strength_ratio(crack);
  return strength_ratio(crack) * crack.fracture_energy / crack.shear_fracture_energy;
}

double length_of_slip(const ChainState (&state)[3]) { return std::hypot(state[1].stretch[0], state[2].stretch[0]); }

/// One contact point within one step. The law responds to a motion of the crack like a spring: its stress is the trial
/// stress, which it has without such a motion, minus stiffness times motion.
struct Point {
  const Crack& crack;
  double trial_normal = 0, stiffness_normal = 0;  ///< [Pa], [Pa/m]
  Vector2d trial_shear = Vector2d::Zero();
  double stiffness_shear = 0;  ///< 0: no shear
  double opening_before = 0, largest_before = 0;
  Vector2d slip_before = Vector2d::Zero();

  /// Stresses and openings that fulfil all equations but one: the effective opening need not be y.
  struct Trial {
    double opening = 0, normal = 0;
    Vector2d slip, shear, friction;
  };

  double effective(const Trial& at) const { return std::hypot(at.opening, slip_weight(crack) * at.slip.norm()); }

  /// Returns the secant stiffness K = t(y)/y of the opened crack [Pa/m]; 0 for an intact point.
  double secant(double y) const { return y > 0 ? cohesive_stress(crack, y) / y : 0; }
  double shear_secant(double y) const { return strength_ratio(crack) * slip_weight(crack) * secant(y); }

  /// Returns the point if its largest effective opening is y > 0.
  Trial at(double y) const {
    Trial out;
    // Normal: the law gives trial − stiffness·(w − w_before), and the crack gives K·w. The faces do not overlap.
    out.opening = (trial_normal + stiffness_normal * opening_before) / (stiffness_normal + secant(y));
    out.normal = secant(y) * out.opening;
    double pressure = 0;
    if (out.opening < 0) {
      out.opening = 0;
      out.normal = trial_normal + stiffness_normal * opening_before;
      pressure = -out.normal;
    }
    out.slip = slip_before;
    out.shear = trial_shear;
    out.friction = Vector2d::Zero();
    if (stiffness_shear == 0) return out;
    // Shear: a slider acts in parallel with the cohesive spring, and bears the remaining shear stress.
    const double mu = crack.residual_friction +
                      (crack.friction - crack.residual_friction) * cohesive_stress(crack, y) / crack.tensile_strength;
    const Vector2d kept = trial_shear - shear_secant(y) * slip_before;  // on the slider if it does not move
    if (out.opening == 0 && pressure > 0 && kept.norm() <= mu * pressure) {
      out.friction = kept;
      return out;
    }
    // The slider bears μ·N along the direction of sliding, in which the law and the cohesive spring move.
    if (pressure > 0) out.friction = mu * pressure * kept.normalized();
    out.slip += (kept - out.friction) / (stiffness_shear + shear_secant(y));
    out.shear = shear_secant(y) * out.slip + out.friction;
    return out;
  }

  /// Returns whether an intact point stays intact: (C.6).
  bool stays_intact() const {
    const double tension = std::max(trial_normal, 0.0), pressure = std::max(-trial_normal, 0.0);
    const double shear = std::max(trial_shear.norm() - crack.friction * pressure, 0.0);
    return std::hypot(tension / crack.tensile_strength, shear / crack.shear_strength) <= 1;
  }

  /// Finds the y above the largest effective opening so far at which the effective opening is y.
  double grown() const {
    const auto opens_more = [&](double y) { return effective(at(y)) > y; };
    double low = largest_before, high = std::max(low, 1e-12);
    while (opens_more(high)) low = high, high *= 2;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (opens_more(middle) ? low : high) = middle;
    }
    return high;
  }
};

/// Returns Φ, the energy that an opening up to y in a fixed direction has dissipated [J/m²].
double dissipated(const Crack& crack, double y) { return cohesive_work(crack, y) - cohesive_stress(crack, y) * y / 2; }

/// Returns the energy of openings over the energy of effective openings, which is not 1 if G_f2 is not G_f.
double energy_ratio(const Crack& crack, double opening, const Vector2d& slip) {
  const double effective = std::hypot(opening, slip_weight(crack) * slip.norm());
  if (effective == 0) return 1;
  const double shear = strength_ratio(crack) * slip_weight(crack) * slip.squaredNorm();
  return (opening * opening + shear) / (effective * effective);
}

/// Takes one step of a point. with_crack() says where the numbers of the crack are.
void advance(const ReferenceLaw& chain, const Crack& crack, double area, double length, double dt,
             const std::array<double, 3>& dx, ChainState (&state)[3]) {
  const double scale[3] = {area / length, chain.alpha * area / length, chain.alpha * area / length};
  const auto chain_after = [&](std::size_t axis, double moved) {
    ChainState out{state[axis].force, {state[axis].stretch.begin() + 2, state[axis].stretch.end()}};
    advance_chain(chain, scale[axis], dt, moved, out);
    return out;
  };
  // The chain is linear in its motion: from rest, a motion of 1 m gives its stiffness.
  const auto stiffness = [&](std::size_t axis) {
    ChainState rest{0, std::vector<double>(chain.units.size(), 0.0)};
    advance_chain(chain, scale[axis], dt, 1, rest);
    return rest.force / area;
  };
  const bool sheared = chain.alpha > 0;
  Point point{crack};
  point.trial_normal = chain_after(0, dx[0]).force / area;
  point.stiffness_normal = stiffness(0);
  if (sheared) {
    point.trial_shear = Vector2d(chain_after(1, dx[1]).force, chain_after(2, dx[2]).force) / area;
    point.stiffness_shear = stiffness(1);
  }
  point.opening_before = state[0].stretch[0];
  point.slip_before = {state[1].stretch[0], state[2].stretch[0]};
  const double y = point.largest_before = state[0].stretch[1];
  const Vector2d shear_before = Vector2d(state[1].force, state[2].force) / area;
  const double normal_before = state[0].force / area;

  double y_after = y;
  Point::Trial end{0, point.trial_normal, Vector2d::Zero(), point.trial_shear, Vector2d::Zero()};
  if (y > 0 || !point.stays_intact()) {
    if (y == 0 || point.effective(point.at(y)) > y) y_after = point.grown();
    end = point.at(y_after);
  }

  // Energies
  const Vector2d friction_before =
      y > 0 ? Vector2d(shear_before - point.shear_secant(y) * point.slip_before) : end.friction;
  state[1].stretch[1] += (friction_before + end.friction).dot(end.slip - point.slip_before) / 2;
  if (crack.softening == Softening::brittle) {
    if (y == 0) state[2].stretch[1] += (normal_before * end.opening + shear_before.dot(end.slip)) / 2;
  } else {
    const double after = energy_ratio(crack, end.opening, end.slip);
    const double before = y > 0 ? energy_ratio(crack, point.opening_before, point.slip_before) : after;
    state[2].stretch[1] += (before + after) / 2 * (dissipated(crack, y_after) - dissipated(crack, y));
  }

  // The chain takes the part of the motion that the crack does not take.
  const double moved[3] = {dx[0] - (end.opening - point.opening_before), dx[1] - (end.slip - point.slip_before)[0],
                           dx[2] - (end.slip - point.slip_before)[1]};
  const double stress[3] = {end.normal, end.shear[0], end.shear[1]};
  for (std::size_t axis = 0; axis < (sheared ? 3u : 1u); ++axis) {
    const ChainState after = chain_after(axis, moved[axis]);
    state[axis].force = stress[axis] * area;
    std::copy(after.stretch.begin(), after.stretch.end(), state[axis].stretch.begin() + 2);
  }
  state[0].stretch[0] = end.opening;
  state[1].stretch[0] = end.slip[0], state[2].stretch[0] = end.slip[1];
  state[0].stretch[1] = y_after;
}

Break break_of(const Crack& crack, const ChainState (&state)[3]) {
  const double y = state[0].stretch[1], end = Crack::separated_stress * crack.tensile_strength;
  const bool separated = y > 0 && (crack.softening == Softening::exponential ? cohesive_stress(crack, y) <= end
                                                                             : cohesive_stress(crack, y) == 0);
  if (!separated) return Break::none;
  return slip_weight(crack) * length_of_slip(state) > state[0].stretch[0] ? Break::shear : Break::tension;
}

laws::PointCrack crack_of(const Crack& crack, const ChainState (&state)[3]) {
  laws::PointCrack out{state[0].stretch[0], length_of_slip(state), 0, state[2].stretch[1], state[1].stretch[1]};
  const double y = state[0].stretch[1];
  if (y == 0) return out;
  const double t = cohesive_stress(crack, y), shear = strength_ratio(crack) * slip_weight(crack);
  out.damage = 1 - t / crack.tensile_strength;
  out.energy += t / y * (out.opening * out.opening + shear * out.slip * out.slip) / 2;
  return out;
}

}  // namespace

double cohesive_stress(const Crack& crack, double y) {
  const double f = crack.tensile_strength, unit = crack.fracture_energy / f;
  switch (crack.softening) {
    case Softening::linear:
      return f * std::max(0.0, 1 - y / (2 * unit));
    case Softening::bilinear: {
      const double y_1 = crack.kink_opening * unit, y_f = (2 - crack.kink_opening) / crack.kink_stress * unit;
      if (y < y_1) return f * (1 - (1 - crack.kink_stress) * y / y_1);
      return f * crack.kink_stress * std::max(0.0, (y_f - y) / (y_f - y_1));
    }
    case Softening::exponential:
      return f * std::exp(-y / unit);
    case Softening::brittle:
      break;
  }
  return y > 0 ? 0 : f;
}

double cohesive_work(const Crack& crack, double y) {
  const double f = crack.tensile_strength, unit = crack.fracture_energy / f, t = cohesive_stress(crack, y);
  switch (crack.softening) {
    case Softening::linear:
      return t > 0 ? (f + t) / 2 * y : crack.fracture_energy;
    case Softening::bilinear: {
      const double y_1 = crack.kink_opening * unit, kink = crack.kink_stress * f;
      if (y < y_1) return (f + t) / 2 * y;
      return t > 0 ? (f + kink) / 2 * y_1 + (kink + t) / 2 * (y - y_1) : crack.fracture_energy;
    }
    case Softening::exponential:
      return -crack.fracture_energy * std::expm1(-y / unit);
    case Softening::brittle:
      break;
  }
  return 0;
}

ReferenceLaw with_crack(const ReferenceLaw& chain, const Crack& crack, const std::string& pair) {
  const auto positive = [&](const char* what, double value) {
    require_crack(std::isfinite(value) && value > 0, pair, what, value, "a positive number");
  };
  positive("tensile_strength", crack.tensile_strength);
  positive("shear_strength", crack.shear_strength);
  if (crack.softening != Softening::brittle) {
    positive("fracture_energy", crack.fracture_energy);
    positive("shear_fracture_energy", crack.shear_fracture_energy);
  }
  require_crack(std::isfinite(crack.residual_friction) && crack.residual_friction >= 0, pair, "residual_friction",
                crack.residual_friction, "a coefficient of at least 0");
  require_crack(std::isfinite(crack.friction) && crack.friction >= crack.residual_friction, pair, "friction",
                crack.friction, "a coefficient of at least residual_friction");
  ReferenceLaw out = chain;
  out.kept = 2 + static_cast<int>(chain.units.size());
  out.point = [chain, crack](double area, double length, double dt, const std::array<double, 3>& dx,
                             ChainState(&state)[3]) { advance(chain, crack, area, length, dt, dx, state); };
  out.break_of = [crack](const ChainState(&state)[3]) { return break_of(crack, state); };
  out.crack_of = [crack](const ChainState(&state)[3]) { return crack_of(crack, state); };
  return out;
}

}  // namespace macadam::reference
