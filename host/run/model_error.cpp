// SPDX-License-Identifier: GPL-3.0-or-later
// model_error.cpp  Finds the error of the model in the table of the study.
#include "host/run/model_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/run/error_model.hpp"
#include "host/scene/law_range.hpp"

namespace macadam {

std::optional<ModelError> model_error(bool voids, double rock, double ratio) {
  // The specimens of the study have up to 0.5 % more rock than their nominal 20, 40 and 55 %.
  constexpr double margin = 0.005;
  double row = std::numeric_limits<double>::infinity(), below = 0, above = row;
  for (const StudiedModel& m : studied_models)
    if (m.voids == voids && m.rock + margin >= rock) row = std::min(row, m.rock);
  for (const StudiedModel& m : studied_models) {
    if (m.voids != voids || m.rock != row) continue;
    if (m.ratio <= ratio) below = std::max(below, m.ratio);
    if (m.ratio >= ratio) above = std::min(above, m.ratio);
  }
  if (!std::isfinite(row) || !std::isfinite(above)) return {};
  ModelError out;
  for (const StudiedModel& m : studied_models) {
    if (m.voids != voids || m.rock != row || (m.ratio != below && m.ratio != above)) continue;
    out.e_star = std::max(out.e_star, m.error.e_star);
    out.uncertainty = std::max(out.uncertainty, m.error.uncertainty);
    out.phase_deg = std::max(out.phase_deg, m.error.phase_deg);
  }
  return out;
}

std::optional<ModelErrorOfRun> model_error_of(const Scene& scene, const Preparation& prepared) {
  constexpr auto mm = static_cast<std::size_t>(PairType::mm);
  if (scene.network.rule != ContactRule::series || !prepared.rock || !scene.materials.rock_modulus || !scene.laws[mm])
    return {};
  ModelErrorOfRun out;
  out.rock = prepared.rock->rock_nominal.value_or(prepared.rock->rock_cells);
  if (!(out.rock > 0)) return {};
  out.voids = !prepared.specimen.voids.empty();
  const auto [low, high] = scene::frequencies_used(scene.experiment);
  std::vector<LawTable> tables;
  for (const double t : temperatures_of(scene.experiment)) tables.push_back(laws_at(scene, t));
  if (tables.empty()) tables.push_back(scene.laws);
  out.lowest_ratio = std::numeric_limits<double>::infinity();
  for (const LawTable& laws : tables) {
    for (const double hz : {low, high}) {
      const double ratio = *scene.materials.rock_modulus / stiffness_at(*laws[mm], 2 * std::numbers::pi * hz);
      out.lowest_ratio = std::min(out.lowest_ratio, ratio);
      out.highest_ratio = std::max(out.highest_ratio, ratio);
    }
  }
  const auto lowest = model_error(out.voids, out.rock, out.lowest_ratio);
  const auto highest = model_error(out.voids, out.rock, out.highest_ratio);
  if (!lowest || !highest) return out;
  out.error = ModelError{std::max(lowest->e_star, highest->e_star), std::max(lowest->uncertainty, highest->uncertainty),
                         std::max(lowest->phase_deg, highest->phase_deg)};
  return out;
}

std::string words_of(const ModelErrorOfRun& of) {
  const std::string where =
      fmt::format("rule \"series\", {:.0f} % of rock{}, rock {:.3g} to {:.3g} times as stiff as the mastic",
                  100 * of.rock, of.voids ? ", voids" : "", of.lowest_ratio, of.highest_ratio);
  if (!of.error)
    return fmt::format(
        "error of the model: unknown, because {} is outside of the studied range (up to 55 % of rock, with voids 40 %, "
        "and a ratio of 200)",
        where);
  return fmt::format(
      "error of the model: {}: such networks differed by up to {:.2g} % of |E*| and {:.2g} degrees from the continuum, "
      "whose |E*| has an uncertainty of {:.2g} %; the numerical error comes in addition",
      where, 100 * of.error->e_star, of.error->phase_deg, 100 * of.error->uncertainty);
}

}  // namespace macadam
