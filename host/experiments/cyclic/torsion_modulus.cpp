// SPDX-License-Identifier: GPL-3.0-or-later
// torsion_modulus.cpp  Computes the torque per turn of a cylinder from its shear modulus, T/θ = G*·J/h.
#include "host/experiments/cyclic/torsion_modulus.hpp"

#include <numbers>

namespace macadam {

void observe_torsion(const Specimen& specimen, const HarmonicResult& state, experiments::HarmonicFrequency& out) {
  const Domain& cylinder = specimen.box;
  const auto modulus = std::polar(state.top.e_star_pa, state.top.phase_deg * std::numbers::pi / 180);
  out.torque_per_turn = modulus * (cylinder.torsion_constant().value() / cylinder.gauge_length());
  out.shear = true;
  out.poisson_ratio.reset();  // the side of a turned cylinder does not move outwards
}

}  // namespace macadam
