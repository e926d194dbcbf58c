// SPDX-License-Identifier: GPL-3.0-or-later
// cell_volumes.cpp  Applies the rule "volumetric". Contacts get the lengths of the rule "series", converted from the
// modulus E to 2μ of each phase. A facet that is not a contact is free: its opening follows from zero stress on it,
// which reduces λ of its cell.
#include "host/network/cell_volumes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "macadam/error.hpp"

namespace macadam {
namespace {

void require_poisson_ratio(const char* phase, double found) {
  if (!(found > -1 && found < 0.5))
    throw InputError("network", 0, std::string("Poisson's ratio of the ") + phase, fmt::format("{}", found),
                     "a ratio above -1 and below 0.5");
}

/// Returns, for each particle, Σ A·h over its free facets [m³], where h is the distance of the facet from the centre of
/// the particle. The facet of a void may lie beyond the centre; it then counts as 0.
std::vector<double> free_volumes(const ContactNetwork& network, const Specimen& specimen,
                                 const Tessellation& tessellation) {
  const auto particles = static_cast<std::int32_t>(specimen.size());
  std::vector<double> out(specimen.size(), 0);
  std::size_t next = 0;  // facets and contacts have the same order
  for (const Facet& f : tessellation.facets) {
    const bool contact =
        next < network.contacts.size() && network.contacts[next].a == f.a && network.contacts[next].b == f.b;
    // a contact that a notch shortened leaves the other part of its facet free
    const double free_area = contact ? f.area - network.contacts[next++].area : f.area;
    if (free_area <= 1e-12 * f.area) continue;
    const auto add = [&](std::int32_t cell, double sign) {
      if (cell < 0 || cell >= particles) return;
      const auto i = static_cast<std::size_t>(cell);
      out[i] += free_area * std::max(0.0, sign * dot(f.centroid - specimen.centre[i], f.normal));
    };
    add(f.a, 1), add(f.b, -1);
  }
  return out;
}

}  // namespace

void apply_volumetric(ContactNetwork& network, const Specimen& specimen, const Tessellation& tessellation,
                      const RockSurfaces& rock, const PhaseConstants& constants) {
  require_poisson_ratio("mastic", constants.mastic_poisson_ratio);
  require_poisson_ratio("rock", constants.rock_poisson_ratio);
  apply_series(network, specimen, rock, constants.rock_modulus, constants.mastic_poisson_ratio);
  const double of_mastic = 1 + constants.mastic_poisson_ratio, of_rock = 1 + constants.rock_poisson_ratio;
  for (Contact& c : network.contacts) {
    if (c.pair == PairType::inner || c.pair == PairType::aw) {
      c.length *= of_rock;
    } else if (c.pair == PairType::aa) {  // length and α already contain λ + 2μ and μ of the film
      c.series *= of_rock;
    } else {
      c.length *= of_mastic;
      c.series *= of_rock / of_mastic;
    }
  }
  const std::vector<double> free = free_volumes(network, specimen, tessellation);
  network.cells.resize(specimen.size());
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const bool mastic = specimen.phase[i] == Phase::mastic;
    const double nu = mastic ? constants.mastic_poisson_ratio : constants.rock_poisson_ratio,
                 ratio = nu / (1 - 2 * nu),  // λ/2μ
        volume = tessellation.cell_volume[i];
    // λ'·(1 + ν)²/(E·V) with λ' = λ/(1 + λ/2μ·Σ A·h/V) and 2μ = E/(1 + ν)
    const double with_free = volume + ratio * free[i];
    network.cells[i] = {ratio * (1 + nu) / with_free, mastic ? PairType::mm : PairType::inner, volume / with_free};
  }
  network.rule = ContactRule::volumetric;
  network.rock_poisson_ratio = constants.rock_poisson_ratio;
}

}  // namespace macadam
