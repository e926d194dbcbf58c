// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_law.cpp  Implements the trapezoidal rule (Eq. 13–17) for a chain of springs and dashpots, derived
/// independently.
#include "host/reference/reference_law.hpp"

#include <cmath>

#include <fmt/format.h>

#include "host/reference/reference_crack.hpp"
#include "macadam/error.hpp"

namespace macadam::reference {
namespace {

/// \throws InputError naming the pair and the parameter, if `good` is false.
void require(bool good, const std::string& pair, const char* what, double found, const char* expected) {
  if (!good) throw InputError("law of pair " + pair, 0, what, fmt::format("{}", found), expected);
}

ReferenceLaw read(const laws::Elastic& law, const std::string& pair) {
  require(std::isfinite(law.E) && law.E >= 0, pair, "E", law.E, "a modulus of at least 0 Pa");
  ReferenceLaw out;
  out.E_m = law.E;
  out.alpha = law.alpha;
  return out;
}

ReferenceLaw read(const laws::GeneralisedKelvin& law, const std::string& pair) {
  require(std::isfinite(law.E_m) && law.E_m > 0, pair, "E_m", law.E_m, "a positive modulus");
  require(law.C_m > 0, pair, "C_m", law.C_m, "a positive viscosity or infinity");
  if (law.E.size() != law.C.size()) {
    throw InputError("law of pair " + pair, 0, "Kelvin units", fmt::format("{} E and {} C", law.E.size(), law.C.size()),
                     "as many E as C");
  }
  ReferenceLaw out{law.E_m, law.C_m, {}, law.alpha, {}};
  for (std::size_t l = 0; l < law.E.size(); ++l) {
    require(std::isfinite(law.E[l]) && law.E[l] >= 0, pair, "E of a Kelvin unit", law.E[l],
            "a modulus of at least 0 Pa");
    require(law.C[l] > 0, pair, "C of a Kelvin unit", law.C[l], "a positive viscosity");
    out.units.push_back({law.E[l], law.C[l]});
  }
  return out;
}

// The bond has two springs, k = E·A_J/d along the normal and α·k in shear. The state has the stretch of each spring as
// well as its force. So the opening is known after the bond has broken, and a point that closes again transfers
// pressure. Stresses are forces over A_J.
ReferenceLaw read(const laws::BrittleBond& law, const std::string& pair) {
  require(std::isfinite(law.E) && law.E > 0, pair, "E", law.E, "a positive modulus");
  require(law.tensile_strength > 0, pair, "tensile_strength", law.tensile_strength, "a positive strength");
  require(law.shear_strength > 0, pair, "shear_strength", law.shear_strength, "a positive strength or infinity");
  ReferenceLaw out;
  out.E_m = law.E;
  out.alpha = law.alpha;
  out.kept = 2;  // two numbers: the stretch and, in component 0 only, how the point broke
  out.break_of = [](const ChainState(&chain)[3]) { return static_cast<Break>(static_cast<int>(chain[0].stretch[1])); };
  out.point = [law](double area, double length, double, const std::array<double, 3>& dx, ChainState(&chain)[3]) {
    const double k[3] = {law.E * area / length, law.alpha * law.E * area / length, law.alpha * law.E * area / length};
    for (int axis = 0; axis < 3; ++axis) {
      chain[axis].stretch[0] += dx[static_cast<std::size_t>(axis)];
      chain[axis].force = k[axis] * chain[axis].stretch[0];
    }
    double& broken = chain[0].stretch[1];
    const double tension = chain[0].force / area, shear = std::hypot(chain[1].force, chain[2].force) / area;
    if (broken == 0 && tension > law.tensile_strength) broken = static_cast<double>(Break::tension);
    if (broken == 0 && shear > law.shear_strength) broken = static_cast<double>(Break::shear);
    if (broken == 0) return;
    if (chain[0].force > 0) chain[0].force = 0;
    chain[1].force = chain[2].force = 0;
  };
  return out;
}

template <class Chain>
ReferenceLaw read(const laws::Cracked<Chain>& law, const std::string& pair) {
  require(law.instantaneous() > 0, pair, "modulus", law.instantaneous(),
          "a positive modulus, because the law has a crack");
  return with_crack(read(static_cast<const Chain&>(law), pair), law.crack, pair);
}

}  // namespace

ReferenceLaw make_reference_law(const Law& law, const std::string& pair) {
  ReferenceLaw out = std::visit([&](const auto& l) { return read(l, pair); }, law);
  require(std::isfinite(out.alpha) && out.alpha >= 0, pair, "alpha", out.alpha, "a ratio of at least 0");
  return out;
}

// All elements carry the same force f, which is f0 at the start of the step and f0 + Δf at its end. The trapezoidal
// rule replaces every f by its mean f0 + Δf/2, and every stretch by its mean as well:
//
//   spring            Δx_m = Δf/k_m
//   dashpot           Δx_η = (Δt/η_m)·(f0 + Δf/2)
//   Kelvin unit       η·Δx_l/Δt + k·(x_l + Δx_l/2) = f0 + Δf/2
//                     ⇒ Δx_l = μ_l·(f0 + Δf/2 − k·x_l)    with μ_l = (Δt/η)/(1 + k·Δt/(2η))
//
// The stretches add up to dx. With the terms of Δf on the left:
//
//   Δf·[ 1/k_m + Δt/(2η_m) + Σ μ_l/2 ] = dx − (Δt/η_m)·f0 − Σ μ_l·(f0 − k·x_l)
//
// With a = 1 + kΔt/(2η) and b = 1 − kΔt/(2η), the bracket is c of [1], Eq. 15, and μ_l·k·x_l = (1 − b/a)·x_l. Adding
// c·f0 on both sides gives
//   c·f1 = dx + Σ (1 − b/a)·x_l − g·f0,   g = Σ μ_l/2 − 1/k_m + Δt/(2η_m),
// so that Eq. 13 holds if its factor (1 + g/c) stands outside the bracket. The new stretch is
//   x_l + Δx_l = [b·x_l + Δt/(2η)·(f1 + f0)]/a,
// which is Eq. 14 with the sum of the two forces in place of their difference.
void advance_chain(const ReferenceLaw& law, double scale, double dt, double dx, ChainState& state, double rock) {
  const auto mobility = [&](const KelvinUnit& unit) {
    return dt / (unit.C * scale) / (1 + dt * unit.E / (2 * unit.C));  // μ_l [m/N]
  };
  const double f0 = state.force;
  const double mobility_m = dt / (law.C_m * scale);

  double compliance = 1 / (law.E_m * scale) + rock / scale + mobility_m / 2;
  double flow = mobility_m * f0;
  for (std::size_t l = 0; l < law.units.size(); ++l) {
    const double mu = mobility(law.units[l]);
    compliance += mu / 2;
    flow += mu * (f0 - law.units[l].E * scale * state.stretch[l]);
  }
  const double df = (dx - flow) / compliance;

  for (std::size_t l = 0; l < law.units.size(); ++l) {
    state.stretch[l] += mobility(law.units[l]) * (f0 + df / 2 - law.units[l].E * scale * state.stretch[l]);
  }
  state.force = f0 + df;
}

}  // namespace macadam::reference
