// SPDX-License-Identifier: GPL-3.0-or-later
// summary.cpp  The run as JSON; keys of the first level are fixed for readers of older runs.
#include "host/simulation/summary.hpp"

#include <nlohmann/json.hpp>
#include <numbers>

#include "macadam/version.hpp"

namespace macadam {
namespace {

using Json = nlohmann::ordered_json;

Json volume_fractions(const Specimen& specimen, const Tessellation& tessellation) {
  double spheres[2] = {0, 0}, cells[2] = {0, 0};
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const int phase = specimen.phase[i] == Phase::aggregate ? 0 : 1;
    const double r = specimen.radius[i];
    spheres[phase] += 4.0 / 3.0 * std::numbers::pi * r * r * r;
    cells[phase] += tessellation.cell_volume[i];
  }
  const double box = specimen.box.volume();
  return {{"aggregate", spheres[0] / box},
          {"mastic", spheres[1] / box},
          {"aggregate_cells", cells[0] / box},
          {"mastic_cells", cells[1] / box}};
}

Json frequency_json(const FrequencyResult& f) {
  const CyclicResult& c = f.cyclic;
  return {{"frequency_hz", f.frequency_hz},
          {"e_star_pa", c.fit.e_star_pa},
          {"phase_deg", c.fit.phase_deg},
          {"method", "explicit"},
          {"residual", c.fit_rms},
          {"e_star_peaks_pa", c.peaks.e_star_pa},
          {"phase_peaks_deg", c.peaks.phase_deg},
          {"change_e_star", c.change_e_star},
          {"change_phase_deg", c.change_phase_deg},
          {"density_scaling", f.density_scaling},
          {"dt_s", f.dt_s},
          {"steps", f.steps},
          {"solve_s", f.seconds}};
}

}  // namespace

std::string summary_json(const Scene& scene, const Preparation& prepared, const RunResult& result,
                         const std::string& status) {
  Json out;
  out["status"] = status;
  out["macadam"] = version();
  out["scene"] = scene.file.string();
  out["particles"] = prepared.specimen.size();
  const Vec3d& size = prepared.specimen.box.size;
  out["box_m"] = {size.x, size.y, size.z};
  for (const PairType pair : {PairType::aa, PairType::ma, PairType::mm, PairType::inner, PairType::aw, PairType::mw}) {
    out["contacts"][to_string(pair)] = prepared.network.count[static_cast<std::size_t>(pair)];
  }
  out["contact_points"] = prepared.network.point_area.size();
  out["dropped"] = {{"gap", prepared.network.dropped_gap}, {"area", prepared.network.dropped_area}};
  out["volume_fractions"] = volume_fractions(prepared.specimen, prepared.tessellation);
  for (const CompositionRow& row : prepared.composition) {
    out["composition"].push_back({{"class", row.name},
                                  {"count_asked", row.count_asked},
                                  {"count", row.count},
                                  {"fraction_asked", row.fraction_asked},
                                  {"fraction", row.fraction}});
  }
  if (!prepared.composition.empty()) {
    out["specimen"] = {{"seed", scene.specimen.seed}, {"aggregates_held", scene.specimen.fix_aggregates}};
  }
  out["results"] = Json::array();
  std::int64_t steps = 0;
  double solve = 0;
  for (const FrequencyResult& f : result.frequencies) {
    out["results"].push_back(frequency_json(f));
    steps += f.steps;
    solve += f.seconds;
  }
  out["solver"] = {{"method", "explicit"},
                   {"dt_s", result.frequencies.empty() ? Json() : Json(result.frequencies.back().dt_s)},
                   {"steps", steps},
                   {"backend", to_string(result.backend)},
                   {"precision", to_string(scene.solver.precision)},
                   {"form", to_string(scene.solver.form)},
                   {"geometry", to_string(scene.solver.geometry)},
                   {"quadrature", scene.network.quadrature == Quadrature::exact ? "exact" : "lumped"},
                   {"damping", {{"kind", to_string(scene.solver.damping_kind)}, {"value", scene.solver.damping}}},
                   {"strain_amplitude", scene.loading.strain_amplitude},
                   {"cycles", scene.loading.cycles},
                   {"reaction", "top wall"},
                   {"description", result.stepper},
                   {"critical_particle", result.critical_particle},
                   {"bytes", result.bytes}};
  out["timing_s"] = {{"specimen", prepared.seconds_specimen},
                     {"tessellation", prepared.seconds_tessellation},
                     {"network", prepared.seconds_network},
                     {"solve", solve}};
  return out.dump(2) + "\n";
}

}  // namespace macadam
