// SPDX-License-Identifier: GPL-3.0-or-later
// recipe_summary.cpp  Writes densities, voids, classes, mastic and gradation of a mix design as JSON. Fractions are 0
// to 1.
#include "host/simulation/recipe_summary.hpp"

namespace macadam {

nlohmann::ordered_json recipe_json(const MixDesign& design, const std::vector<CompositionRow>& composition) {
  using Json = nlohmann::ordered_json;
  const MixVolumes v = volumes_of(design);
  Json out = {{"maximum_density", v.maximum_density},
              {"bulk_density", v.bulk_density},
              {"air_voids", v.air_voids},
              {"vma", v.vma},
              {"vfb", v.vfb},
              {"binder", v.binder},
              {"effective_binder", v.effective_binder},
              {"absorbed_binder", v.absorbed_binder},
              {"cut_m", design.cut}};
  out["aggregate"] = {{"mass", v.aggregate_mass}, {"volume", v.aggregate_volume}, {"density", v.aggregate_density}};
  out["mastic"] = {{"mass", v.mastic_mass},
                   {"volume", v.mastic_volume},
                   {"density", v.mastic_density},
                   {"fine_aggregate_mass", v.mastic_fine_mass},
                   {"filler_mass", v.mastic_filler_mass},
                   {"binder_mass", v.mastic_binder_mass}};
  out["classes"] = Json::array();
  for (std::size_t k = 0; k < v.classes.size(); ++k) {
    const MixClass& c = v.classes[k];
    out["classes"].push_back({{"class", composition.at(k).name},
                              {"sieve_m", {c.sieve_min, c.sieve_max}},
                              {"mass", c.mass},
                              {"volume", c.volume},
                              {"density", c.density}});
  }
  // classes and mastic as they are in the specimen, by the volumes of shapes, single spheres and mastic spheres
  double volume = composition.at(v.classes.size()).fraction, mass = volume * v.mastic_density;
  for (std::size_t k = 0; k < v.classes.size(); ++k) {
    volume += composition[k].fraction;
    mass += composition[k].fraction * v.classes[k].density * (1 + v.absorbed_binder);
  }
  out["reached"] = {{"bulk_density", mass}, {"air_voids", 1 - volume}};
  out["gradation"] = Json::array();
  for (const GradationRow& row : gradation_of(design, composition))
    out["gradation"].push_back({{"sieve_m", row.size}, {"asked", row.asked}, {"reached", row.reached}});
  if (!design.envelope.empty()) {
    out["envelope"] = Json::array();
    for (const EnvelopePoint& p : design.envelope)
      out["envelope"].push_back({{"sieve_m", p.size}, {"least", p.least}, {"most", p.most}});
    out["outside_of_envelope_m"] = Json::array();
    for (const SievePassing& s : outside_of_envelope(design)) out["outside_of_envelope_m"].push_back(s.size);
  }
  return out;
}

}  // namespace macadam
