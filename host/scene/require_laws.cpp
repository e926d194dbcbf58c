// SPDX-License-Identifier: GPL-3.0-or-later
/// \file require_laws.cpp  Checks, once specimen and contact network are known, that the scene has a density for every
/// phase and a law for every pair that occurs, and that each step of a cracked contact has exactly one solution.
#include <algorithm>

#include <fmt/format.h>

#include "macadam/error.hpp"
#include "macadam/scene.hpp"

namespace macadam {
namespace {

/// Ratio of shear to normal stiffness of a contact with a law. Rock in series weakens the two differently.
template <class Chain>
double shear_ratio(const laws::Cracked<Chain>& law, const Contact& c) {
  const double r = c.series * law.instantaneous();
  return law.alpha * (1 + r) / (1 + law.alpha * r);
}

/// Returns the fracture energy that a contact needs [J/m²] (docs/cracks.md, (C.13)).
template <class Chain>
double least_energy(const laws::Cracked<Chain>& law, const Contact& c) {
  const double modulus = law.instantaneous() / (1 + c.series * law.instantaneous());
  return law.crack.least_fracture_energy(modulus, shear_ratio(law, c), c.length);
}

/// Checks that the fracture energy of a law with a crack suffices for every contact of its pair: with less energy, a
/// point loses its stress at a fixed displacement of the particles, and a step of this contact has more than one
/// solution.
template <class Chain>
void require_one_answer(const Scene& scene, const ContactNetwork& network, PairType pair,
                        const laws::Cracked<Chain>& law) {
  std::size_t number = 0;  // contact that needs the most energy
  double least = -1;
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    if (network.contacts[c].pair != pair) continue;
    const double energy = least_energy(law, network.contacts[c]);
    if (energy > least) least = energy, number = c;
  }
  const Contact& contact = network.contacts[number];
  const laws::Crack& crack = law.crack;
  if (crack.softening == laws::Softening::brittle || crack.fracture_energy > least) return;
  const double alpha = shear_ratio(law, contact), shear = crack.shear_term(alpha);
  const std::string why =
      shear > 1 ? fmt::format(
                      "shear decides: beta_c*beta_w/alpha = {:.4g}*{:.4g}/{:g} = {:.4g} times the energy that "
                      "tension needs; a smaller shear_strength needs less",
                      crack.strength_ratio(), crack.slip_weight(), alpha, shear)
                : fmt::format("tension decides: beta_c*beta_w/alpha = {:.4g} is at most 1", shear);
  throw InputError(scene.file.string(), 0, fmt::format("fracture_energy in crack of pair {}", to_string(pair)),
                   fmt::format("{:g} J/m2", crack.fracture_energy),
                   fmt::format("more than {:.4g} J/m2, which contact {} ({} - {}, {:.4g} m long) needs so that each "
                               "step has one solution; {}",
                               least, number, contact.a, contact.b, contact.length, why));
}

}  // namespace

void require_laws(const Scene& scene, const Specimen& specimen, const ContactNetwork& network) {
  for (const Phase phase : {Phase::aggregate, Phase::mastic}) {
    const auto particles = std::count(specimen.phase.begin(), specimen.phase.end(), phase);
    if (particles > 0 && !(scene.materials.density(phase) > 0)) {
      const std::string name = to_string(phase);
      throw InputError(scene.file.string(), 0, "phase " + name,
                       fmt::format("no density for its {} particles", particles),
                       "[materials." + name + "] with a density");
    }
  }
  for (std::size_t i = 0; i < network.count.size(); ++i) {
    if (network.count[i] > 0 && !scene.laws[i]) {
      const std::string name = to_string(static_cast<PairType>(i));
      throw InputError(scene.file.string(), 0, "pair " + name,
                       fmt::format("no law for its {} contacts", network.count[i]),
                       has_laws_of_phases(scene.network.rule)
                           ? "the laws of both phases in [materials.mastic] and [materials.aggregate]"
                           : "[[contacts]] with pair = \"" + name + "\"");
    }
  }
}

void require_fracture_energies(const Scene& scene, const ContactNetwork& network) {
  for (std::size_t i = 0; i < network.count.size(); ++i) {
    if (network.count[i] == 0) continue;
    std::visit(
        [&]<class L>(const L& law) {
          if constexpr (cracking_law<L>) require_one_answer(scene, network, static_cast<PairType>(i), law);
        },
        *scene.laws[i]);
  }
}

}  // namespace macadam
