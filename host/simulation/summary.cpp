// SPDX-License-Identifier: GPL-3.0-or-later
// summary.cpp  Writes one run as JSON. The keys of the first level are fixed, because programs read the files of older
// runs.
#include "host/simulation/summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "host/experiments/experiment.hpp"
#include "host/files/result_files.hpp"
#include "host/run/checkpoints.hpp"
#include "host/run/model_error.hpp"
#include "host/simulation/recipe_summary.hpp"
#include "macadam/error.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

using Json = nlohmann::ordered_json;

Json volume_fractions(const Specimen& specimen, const Tessellation& tessellation) {
  std::array<double, 3> spheres{}, cells{};  // indexed by Phase
  const Specimen all = with_voids_as_cells(specimen);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto phase = static_cast<std::size_t>(all.phase[i]);
    const double r = all.radius[i];
    spheres[phase] += 4.0 / 3.0 * std::numbers::pi * r * r * r;
    cells[phase] += tessellation.cell_volume[i];
  }
  const double box = specimen.box.volume();
  return {{"aggregate", spheres[0] / box},     {"mastic", spheres[1] / box},     {"void", spheres[2] / box},
          {"aggregate_cells", cells[0] / box}, {"mastic_cells", cells[1] / box}, {"void_cells", cells[2] / box}};
}

/// Returns the settings of the solution; the experiment adds its own settings to them. In a run without time stepping
/// the keys of time stepping are null.
Json solver_json(const Scene& scene, const RunResult& result) {
  Json out = {{"method", to_string(scene.solver.method)},
              {"dt_s", Json()},
              {"steps", Json()},
              {"backend", to_string(result.backend)},
              {"precision", "double"},
              {"description", result.solver},
              {"quadrature", to_string(scene.network.quadrature)},
              {"reaction", "top wall"}};
  if (scene.solver.method == SolverMethod::harmonic) out["inertia"] = scene.solver.inertia;
  return out;
}

}  // namespace

std::string summary_json(const Scene& scene, const Preparation& prepared, const RunResult& result,
                         const std::string& status) {
  Json out;
  out["status"] = status;
  out["warnings"] = result.warnings;
  out["macadam"] = version();
  out["scene"] = scene.file.string();
  if (!scene.changes.empty()) out["set"] = scene.changes;
  out["particles"] = prepared.specimen.size();
  out["voids"] = prepared.specimen.voids.size();
  const Vec3d& size = prepared.specimen.box.size;
  out["box_m"] = {size.x, size.y, size.z};
  if (const Domain& domain = prepared.specimen.box; domain.name() != std::string(domains::Box::name)) {
    out["domain"] = {{"shape", domain.name()},
                     {"section_m2", section_area(domain)},
                     {"gauge_length_m", gauge_length(domain)},
                     {"volume_m3", domain.volume()}};
    const std::vector<domains::Dimension> keys = domain.keys();
    const std::vector<double> values = domain.values();
    for (std::size_t k = 0; k < keys.size(); ++k) out["domain"]["dimensions_m"][keys[k].key] = values[k];
    for (int k = 0; k < wall_count; ++k)
      if (const double area = domain.wall_area(k); area > 0) out["domain"]["walls_m2"][domain.wall_name(k)] = area;
  }
  for (const PairType pair : {PairType::aa, PairType::ma, PairType::mm, PairType::inner, PairType::aw, PairType::mw}) {
    out["contacts"][to_string(pair)] = prepared.network.count[static_cast<std::size_t>(pair)];
  }
  out["contact_points"] = prepared.network.point_area.size();
  out["loose_particles"] = prepared.loose_particles;
  out["second_moment_difference"] = prepared.network.second_moment_difference;
  out["dropped"] = {{"gap", prepared.network.dropped_gap}, {"area", prepared.network.dropped_area}};
  for (const NotchCut& cut : prepared.network.notches) {
    out["notches"].push_back({{"axis", std::string(1, "xyz"[cut.notch.axis])},
                              {"at_m", cut.notch.position},
                              {"removed_contacts", cut.removed},
                              {"shortened_contacts", cut.shortened},
                              {"cut_area_m2", cut.cut_area},
                              {"ligament_m2", cut.ligament}});
  }
  out["volume_fractions"] = volume_fractions(prepared.specimen, prepared.tessellation);
  if (prepared.rock) {
    const RockReport& rock = *prepared.rock;
    out["rule"] = {{"name", to_string(scene.network.rule)},
                   {"rock_fraction_cells", rock.rock_cells},
                   {"rock_fraction_nominal", rock.rock_nominal ? Json(*rock.rock_nominal) : Json()},
                   {"void_fraction_cells", rock.void_cells},
                   {"void_fraction_nominal", rock.void_nominal},
                   {"mastic_centres_in_rock", rock.mastic_centres_in_rock}};
  }
  if (const auto found = model_error_of(scene, prepared)) {
    out["model_error"] = {{"rock_fraction", found->rock},
                          {"ratio", {found->lowest_ratio, found->highest_ratio}},
                          {"e_star", found->error ? Json(found->error->e_star) : Json()},
                          {"phase_deg", found->error ? Json(found->error->phase_deg) : Json()},
                          {"continuum_uncertainty", found->error ? Json(found->error->uncertainty) : Json()},
                          {"words", words_of(*found)}};
  }
  if (scene.mastic_source && scene.mastic_source->computed) {
    const MasticSource::Computed& c = *scene.mastic_source->computed;
    out["mastic"] = {{"from", scene.mastic_source->file.string()},
                     {"frequency_range_hz", {c.lowest_hz, c.highest_hz}},
                     {"units", c.units},
                     {"largest_difference", c.largest_difference},
                     {"folder", c.folder.empty() ? Json() : Json(c.folder.string())},
                     {"kept_before", c.kept_before}};
  }
  for (const CompositionRow& row : prepared.composition) {
    out["composition"].push_back({{"class", row.name},
                                  {"count_asked", row.count_asked},
                                  {"count", row.count},
                                  {"fraction_asked", row.fraction_asked},
                                  {"fraction", row.fraction}});
  }
  if (!prepared.composition.empty()) {
    out["specimen"] = {{"seed", scene.specimen.seed},
                       {"aggregates_held", scene.specimen.fix_aggregates},
                       {"relaxation_iterations", prepared.relaxation_iterations}};
  }
  if (scene.recipe) out["recipe"] = recipe_json(*scene.recipe, prepared.composition);
  out["results"] = Json::array();
  out["solver"] = solver_json(scene, result);
  summarise(scene, result, out);
  const PhaseSeconds& phases = result.phases;
  out["skips"] = Json::array();
  for (const Skip& skip : result.skips) {
    out["skips"].push_back({{"what", skip.what}, {"why", skip.why}, {"effect", skip.effect}});
  }
  out["timing_s"] = {
      {"specimen", prepared.seconds_specimen},
      {"tessellation", prepared.seconds_tessellation},
      {"network", prepared.seconds_network},
      {"solve", solve_seconds(result)},  // of all processes of a resumed run; the phases below are of this process only
      {"start", phases.start},
      {"planning", phases.planning},
      {"preconditioner", phases.preconditioner},
      {"harmonic", phases.harmonic},
      {"stepper", phases.stepper},
      {"stepping", phases.stepping},
      {"writing", phases.writing}};
  // replaces invalid bytes, because a path need not be UTF-8
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void require_no_run(const std::filesystem::path& out) {
  const auto refuse = [&](const std::string& found) {
    throw InputError(
        out.string(), 0, "folder of the specimen", found,
        "a folder without the files of a run, because the specimen's files would replace them; choose another folder");
  };
  if (has_checkpoint(out)) refuse("the checkpoint of a run");
  const std::filesystem::path file = out / "summary.json";
  if (!std::filesystem::exists(file)) return;
  const Json summary = Json::parse(read_whole(file), nullptr, false);
  const auto status = summary.is_object() ? summary.find("status") : summary.end();
  if (!summary.is_object() || status == summary.end()) refuse("a summary.json that Macadam did not write");
  if (*status != "prepared") refuse(fmt::format("a run (summary.json: status {})", status->dump()));
}

}  // namespace macadam
