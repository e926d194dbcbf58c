// SPDX-License-Identifier: GPL-3.0-or-later
// cooling_conditions.cpp  Refuses scenes of kind "cooling" without thermal stress, and methods that cannot follow it.
#include "host/scene/cooling_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "macadam/laws/values.hpp"

namespace macadam::scene {

std::string why_cooling_has_no_steps(const Scene& scene) {
  double stiffest = 0;
  for (const auto& law : facts_of(scene.laws))
    if (law) stiffest = std::max(stiffest, law->instantaneous);
  const double duration = temperature_history_of(scene.experiment).times.back();
  if (!scene.specimen.mastic || !(stiffest > 0) || !(scene.materials.mastic > 0))
    return fmt::format("the test lasts {:.3g} s, which would take too many time steps", duration);
  const double step = 2 * scene.specimen.mastic->radius_min / std::sqrt(stiffest / scene.materials.mastic);
  return fmt::format("the test lasts {:.3g} s, which would take about {:.0e} time steps", duration, duration / step);
}

void require_cooling(const Scene& scene, const Section& root) {
  if (!std::holds_alternative<experiments::Cooling>(scene.experiment)) return;
  const Section loading = root.find("loading")->section();
  if (scene.materials.temperature)
    loading.refuse(
        "kind", "\"cooling\" with temperature in [materials]",
        "no temperature in [materials], because the test has temperatures of its own, and strengths as numbers, "
        "because they do not change during the test");
  if (!scene.materials.expansion.any())
    loading.refuse("kind", "\"cooling\" of materials that do not expand",
                   "expansion in [materials.mastic] or [materials.aggregate], in 1/K");
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!scene.laws[pair] || !laws::flows(*scene.laws[pair])) continue;
    if (std::holds_alternative<laws::NoShift>(scene.shifts[pair]))
      loading.refuse(
          "kind",
          fmt::format("\"cooling\" with a law of {} that relaxes and has no shift",
                      to_string(static_cast<PairType>(pair))),
          "shift = \"wlf\", \"arrhenius\" or \"table\" in each law with viscosities, because they grow as the "
          "specimen cools");
  }
  if (scene.network.lateral_walls)
    root.find("network")->section().refuse("lateral_walls", "true with kind = \"cooling\" in [loading]",
                                           "false, because the sides of the specimen are free in this test");
  if (scene.solver.method != SolverMethod::quasi_static)
    loading.refuse("kind", fmt::format("\"cooling\" with method \"{}\"", to_string(scene.solver.method)),
                   fmt::format("method = \"quasi_static\" in [solver], without keys for time steps, because only "
                               "increments follow a changing temperature; {}",
                               why_cooling_has_no_steps(scene)));
}

}  // namespace macadam::scene
