// SPDX-License-Identifier: GPL-3.0-or-later
/// \file require_laws.cpp  Checks, once specimen and contact network are known, that the scene has a density for every
/// phase and a law for every pair that occurs.
#include <algorithm>

#include <fmt/format.h>

#include "macadam/error.hpp"
#include "macadam/scene.hpp"

namespace macadam {

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
                       scene.network.rule == ContactRule::series
                           ? "the laws of both phases in [materials.mastic] and [materials.aggregate]"
                           : "[[contacts]] with pair = \"" + name + "\"");
    }
  }
}

}  // namespace macadam
