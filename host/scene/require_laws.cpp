// SPDX-License-Identifier: GPL-3.0-or-later
/// \file require_laws.cpp  Checks, once specimen and contact network are known, that the scene has a density for every
/// phase and a law for every pair that occurs, and that each step of a cracked contact has exactly one solution.
#include <algorithm>

#include <fmt/format.h>

#include "macadam/error.hpp"
#include "macadam/scene.hpp"

namespace macadam {
namespace {

/// Returns the longest contact of a pair, which must have contacts.
std::size_t longest_contact(const ContactNetwork& network, PairType pair) {
  std::size_t out = network.contacts.size();
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    if (network.contacts[c].pair != pair) continue;
    if (out == network.contacts.size() || network.contacts[c].length > network.contacts[out].length) out = c;
  }
  return out;
}

/// Checks that the fracture energy of a law with a crack suffices for the longest contact of its pair (docs/cracks.md,
/// (C.13)): with less energy, a point loses its stress at a fixed displacement of the particles, and a step of this
/// contact has more than one solution.
template <class Chain>
void require_one_answer(const Scene& scene, const ContactNetwork& network, PairType pair,
                        const laws::Cracked<Chain>& law) {
  const std::size_t number = longest_contact(network, pair);
  const Contact& contact = network.contacts[number];
  const laws::Crack& crack = law.crack;
  const double least = crack.least_fracture_energy(law.instantaneous(), law.alpha, contact.length);
  if (crack.softening == laws::Softening::brittle || crack.fracture_energy > least) return;
  const double shear = crack.shear_term(law.alpha);
  const std::string why =
      shear > 1 ? fmt::format(
                      "shear decides: beta_c*beta_w/alpha = {:.4g}*{:.4g}/{:g} = {:.4g} times the energy that "
                      "tension needs; a larger alpha or a smaller shear_strength needs less",
                      crack.strength_ratio(), crack.slip_weight(), law.alpha, shear)
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
    if (network.count[i] == 0) continue;
    std::visit(
        [&]<class L>(const L& law) {
          if constexpr (cracking_law<L>) require_one_answer(scene, network, static_cast<PairType>(i), law);
        },
        *scene.laws[i]);
  }
}

}  // namespace macadam
