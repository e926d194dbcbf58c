// SPDX-License-Identifier: GPL-3.0-or-later
// summary.cpp  The run as JSON; keys of the first level are fixed for readers of older runs.
#include "host/simulation/summary.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "host/experiments/experiment.hpp"
#include "host/simulation/checkpoints.hpp"
#include "host/simulation/recipe_summary.hpp"
#include "macadam/error.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

using Json = nlohmann::ordered_json;

Json volume_fractions(const Specimen& specimen, const Tessellation& tessellation) {
  std::array<double, 3> spheres{}, cells{};  // by Phase
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

const char* to_string(SolverMethod method) { return method == SolverMethod::harmonic ? "harmonic" : "explicit"; }

Json error_json(const ErrorEstimate& error) { return {{"e_star", error.e_star}, {"phase_rad", error.phase_rad}}; }

/// Derivatives by the logarithms of the parameters, and what each pair carries.
void add_sensitivities(const FrequencyResult& f, const LawTable& laws, Json& out) {
  out["sensitivities"] = Json::array();
  for (const Sensitivity& s : sensitivities(*f.parts, laws, {0, 2 * std::numbers::pi * f.frequency_hz})) {
    out["sensitivities"].push_back(
        {{"parameter", s.parameter}, {"d_e_star_pa", s.d_e_star_pa}, {"d_phase_deg", s.d_phase_deg}});
  }
  const auto parts = shares(*f.parts);
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (parts[pair] != 0) out["shares"][to_string(static_cast<PairType>(pair))] = parts[pair];
  }
}

Json frequency_json(const FrequencyResult& f, const Scene& scene) {
  Json out = {{"frequency_hz", f.frequency_hz},
              {"e_star_pa", f.stiffness.e_star_pa},
              {"phase_deg", f.stiffness.phase_deg},
              {"method", to_string(f.method)},
              {"residual", f.residual},
              {"density_scaling", f.density_scaling},
              {"solve_s", f.seconds}};
  if (f.temperature_c) {
    out["temperature_c"] = *f.temperature_c;
    if (const auto shift = common_log10_shift(scene, *f.temperature_c)) {
      out["log10_a_T"] = *shift;
      out["reduced_frequency_hz"] = f.frequency_hz * std::pow(10.0, *shift);
    }
  }
  if (std::holds_alternative<experiments::Sweep>(scene.experiment)) {
    const auto e_star = std::polar(f.stiffness.e_star_pa, f.stiffness.phase_deg * std::numbers::pi / 180);
    out["storage_pa"] = e_star.real();
    out["loss_pa"] = e_star.imag();
    out["modulus"] = scene.network.lateral_walls ? "confined" : "uniaxial";
  }
  if (f.cyclic) {
    out["e_star_peaks_pa"] = f.cyclic->peaks.e_star_pa;
    out["phase_peaks_deg"] = f.cyclic->peaks.phase_deg;
    out["change_e_star"] = f.cyclic->change_e_star;
    out["change_phase_deg"] = f.cyclic->change_phase_deg;
    out["dt_s"] = f.dt_s;
    out["steps"] = f.steps;
    out["cycles"] = f.cycles;
    out["start"] = to_string(f.start);
    if (f.predicted) out["predicted_error"] = error_json(*f.predicted);
    if (f.achieved) out["difference_from_harmonic"] = error_json(*f.achieved);
    if (scene.solver.tolerance) out["tolerance_kept"] = f.kept ? Json(*f.kept) : Json();
  }
  if (f.bottom) {
    out["e_star_bottom_pa"] = f.bottom->e_star_pa;
    out["phase_bottom_deg"] = f.bottom->phase_deg;
    out["iterations"] = f.iterations;
    out["linear"] = to_string(f.linear);
    if (scene.output.sensitivities && f.parts)
      add_sensitivities(f, f.temperature_c ? laws_at(scene, *f.temperature_c) : scene.laws, out);
    out["held_force"] = f.held_force;
  }
  return out;
}

/// Settings and cost of the solution; the keys of the time stepping are null for a harmonic one.
Json solver_json(const Scene& scene, const RunResult& result) {
  std::int64_t steps = 0;
  for (const FrequencyResult& f : result.frequencies) steps += f.steps;
  const bool stepped = scene.solver.method == SolverMethod::explicit_;
  const auto last_step = stepped && !result.frequencies.empty() ? Json(result.frequencies.back().dt_s) : Json();
  Json out = {{"method", to_string(scene.solver.method)},
              {"dt_s", last_step},
              {"steps", stepped ? Json(steps) : Json()},
              {"backend", to_string(result.backend)},
              {"precision", stepped ? to_string(result.precision) : "double"},
              {"description", result.solver},
              {"quadrature", to_string(scene.network.quadrature)},
              {"reaction", "top wall"}};
  if (stepped) {
    out["form"] = to_string(result.form);
    out["geometry"] = to_string(result.geometry);
    out["damping"] = {{"kind", to_string(scene.solver.damping_kind)}, {"value", scene.solver.damping}};
    out["strain_amplitude"] = scene.cyclic().strain_amplitude;
    out["tolerance"] = scene.solver.tolerance ? Json(*scene.solver.tolerance) : Json();
    out["decisions"] = result.decisions;
    out["critical_particle"] = result.critical_particle;
    out["critical_dt_s"] = result.critical_dt_s;
    out["bytes"] = result.bytes;
  } else {
    out["inertia"] = scene.solver.inertia;
  }
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
  out["particles"] = prepared.specimen.size();
  out["voids"] = prepared.specimen.voids.size();
  const Vec3d& size = prepared.specimen.box.size;
  out["box_m"] = {size.x, size.y, size.z};
  for (const PairType pair : {PairType::aa, PairType::ma, PairType::mm, PairType::inner, PairType::aw, PairType::mw}) {
    out["contacts"][to_string(pair)] = prepared.network.count[static_cast<std::size_t>(pair)];
  }
  out["contact_points"] = prepared.network.point_area.size();
  out["loose_particles"] = prepared.loose_particles;
  out["second_moment_difference"] = prepared.network.second_moment_difference;
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
    out["specimen"] = {{"seed", scene.specimen.seed},
                       {"aggregates_held", scene.specimen.fix_aggregates},
                       {"relaxation_iterations", prepared.relaxation_iterations}};
  }
  if (scene.recipe) out["recipe"] = recipe_json(*scene.recipe, prepared.composition);
  out["results"] = Json::array();
  const PhaseSeconds& phases = result.phases;
  const bool stepped = scene.solver.method == SolverMethod::explicit_;
  double solve = stepped ? result.seconds_planning : phases.preconditioner;
  for (const FrequencyResult& f : result.frequencies) {
    out["results"].push_back(frequency_json(f, scene));
    solve += f.seconds;
  }
  const auto add = [&]<class Result>(const Result& found) {
    if constexpr (!std::is_same_v<Result, std::monostate>) {
      out["results"].push_back(ResultOf<Result>::summary(found, scene));
      solve += found.material.seconds;
    }
  };
  std::visit(add, result.found);
  out["solver"] = solver_json(scene, result);
  out["skips"] = Json::array();
  for (const Skip& skip : result.skips) {
    out["skips"].push_back({{"what", skip.what}, {"why", skip.why}, {"effect", skip.effect}});
  }
  out["timing_s"] = {{"specimen", prepared.seconds_specimen},
                     {"tessellation", prepared.seconds_tessellation},
                     {"network", prepared.seconds_network},
                     {"solve", solve},  // of all processes of a resumed run; the phases below are of this one
                     {"start", phases.start},
                     {"planning", phases.planning},
                     {"preconditioner", phases.preconditioner},
                     {"harmonic", phases.harmonic},
                     {"stepper", phases.stepper},
                     {"stepping", phases.stepping},
                     {"writing", phases.writing}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // a path need not be UTF-8
}

void require_no_run(const std::filesystem::path& out) {
  const auto refuse = [&](const std::string& found) {
    throw InputError(out.string(), 0, "folder of the specimen", found,
                     "none: its files would replace those of the run; choose another folder");
  };
  if (std::filesystem::exists(out / checkpoint_name)) refuse("the checkpoint of a run");
  const std::filesystem::path file = out / "summary.json";
  if (!std::filesystem::exists(file)) return;
  std::ifstream in(file, std::ios::binary);
  const Json summary = Json::parse(in, nullptr, false);
  const auto status = summary.is_object() ? summary.find("status") : summary.end();
  if (!summary.is_object() || status == summary.end()) refuse("a summary.json that is none of Macadam's");
  if (*status != "prepared") refuse(fmt::format("a run in it (summary.json: {})", status->dump()));
}

}  // namespace macadam
