// SPDX-License-Identifier: GPL-3.0-or-later
// stepped_response.cpp  Reports a stepped test of a load in summary.json and in the text that the command prints.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiments/transient/cooling_results.hpp"
#include "host/experiments/transient/peak_fit.hpp"
#include "host/experiments/transient/standard_results.hpp"
#include "host/experiments/transient/stepped_columns.hpp"
#include "host/experiments/transient/transient_experiment.hpp"
#include "host/run/cracks.hpp"
#include "host/run/step_settings.hpp"

namespace macadam {

using experiments::SteppedPoint;
using experiments::SteppedResponse;

double experiments::SteppedResponse::error() const {
  double out = 0;
  const auto count = static_cast<std::ptrdiff_t>(points.size()) - (rupture ? 1 : 0);
  for (std::ptrdiff_t i = 0; i < count; ++i) out = std::max(out, points[static_cast<std::size_t>(i)].error);
  return out;
}

std::optional<double> experiments::SteppedResponse::energy_error() const {
  if (!cracks || !cracks->sums || damping_kind != Damping::none) return {};
  double missing = 0, work = 0;
  for (const SteppedPoint& p : points) {
    if (!std::isfinite(p.energies.missing())) return {};
    missing = std::max(missing, std::abs(p.energies.missing()));
    work = std::max(work, std::abs(p.energies.work_j));
  }
  return work > 0 ? std::optional(missing / work) : std::nullopt;
}

namespace {

/// Returns whether the test has passed its peak. `found.peak` must have a value.
bool passed_its_peak(const SteppedResponse& found) { return passed_peak(found, found.peak->stress_pa); }

bool measures_strength(const SteppedResponse& found) { return found.peak && !found.points.empty(); }

/// Returns the line about the strength. This line is printed first, because the strength is the main result of such a
/// test.
std::string strength_words(const SteppedResponse& found) {
  const experiments::FittedPeak peak = peak_of(found);
  if (has_standard_results(found)) return standard_results_words(found, passed_its_peak(found));
  std::string out =
      fmt::format("{} {:.6g} MPa at a strain of {:.6g} (t = {:.5g} s){}\n",
                  passed_its_peak(found) ? "strength" : "largest stress", peak.stress_pa / 1e6, peak.strain,
                  found.peak->time_s, passed_its_peak(found) ? "" : "; the strength was not reached");
  if (found.fitted && found.increments) {
    out += fmt::format(
        "the strength is the vertex of a parabola through three increments; the largest stress at the end of an "
        "increment is {:.6g} MPa\n",
        found.peak->stress_pa / 1e6);
  } else if (found.fitted) {
    out += fmt::format(
        "the strength is the maximum of a cubic fit around the peak; the largest single stress is {:.6g} MPa\n",
        found.peak->stress_pa / 1e6);
  }
  return out;
}

/// Returns the error of the balance of energies.
std::optional<double> energy_error_of(const SteppedResponse& found) {
  return found.increments ? std::optional(found.increments->imbalance) : found.energy_error();
}

/// Returns the line about the energies at the end of a test with cracks.
std::string energy_words(const SteppedResponse& found) {
  const experiments::Energies& e = found.points.back().energies;
  const auto error = energy_error_of(found);
  return fmt::format(
      "work {:.4g} J{}: crack {:.4g}, friction {:.4g}, viscous {:.4g}, elastic {:.4g}, kinetic {:.4g}{} J; {}\n",
      e.work_j,
      std::isfinite(found.points.back().temperature_c)
          ? fmt::format(" and {:.4g} J against thermal expansion", e.thermal_j)
          : "",
      e.crack_j, e.friction_j, e.viscous_j, e.elastic_j, e.kinetic_j,
      found.damping_kind != Damping::none ? fmt::format(", damping {:.4g}", e.damping_j)
      : e.damping_j != 0                  ? fmt::format(", drag in sudden drops {:.4g}", e.damping_j)
                                          : "",
      error ? fmt::format("the balance has an error of {:.1e} of the work", *error)
            : "the error of the balance is unknown, because the run has damping or an unknown energy");
}

void add_strength(const SteppedResponse& found, nlohmann::ordered_json& out) {
  using Json = nlohmann::ordered_json;
  const bool passed = passed_its_peak(found);
  const experiments::FittedPeak peak = peak_of(found);
  out["strength_pa"] = passed ? Json(peak.stress_pa) : Json();
  out["strain_at_peak"] = passed ? Json(peak.strain) : Json();
  if (!found.cracks->sums) return;
  out["strength_from"] = found.fitted ? "fit" : "largest stress";
  out["largest_stress_pa"] = found.peak->stress_pa;
  if (found.fitted && !found.increments) out["fit_deviation_pa"] = found.fitted->deviation_pa;
  out["work_of_fracture_j"] = passed ? Json(found.points.back().energies.work_j) : Json();
}

/// Returns `modulus` in summary.json: how the specimen is loaded.
const char* modulus_name(const SteppedResponse& found) {
  if (found.kind == experiments::IndirectTensileStrength::kind) return "indirect_tension";
  if (found.kind == experiments::SemicircularBending::kind) return experiments::SemicircularBending::kind;
  if (found.kind == experiments::ThreePointBending::kind) return experiments::ThreePointBending::kind;
  return found.confined ? "confined" : "uniaxial";
}

/// Returns the same in the words of the printed text.
const char* load_kind_words(const SteppedResponse& found) {
  if (found.kind == experiments::IndirectTensileStrength::kind) return "disc between two strips";
  if (found.kind == experiments::SemicircularBending::kind) return "half disc on two rollers";
  if (found.kind == experiments::ThreePointBending::kind) return "beam on two rollers";
  if (found.kind == experiments::Cooling::kind) return "specimen held between two platens while it cools";
  return modulus_words(found.confined);
}

/// Adds how a test was followed by increments.
void add_increments(const experiments::Increments& found, nlohmann::ordered_json& out) {
  out["increments"] = found.increments;
  out["repeated_increments"] = found.rejected;
  out["linear_systems"] = found.systems;
  out["largest_residual"] = found.residual;
  out["increment_error"] = found.increment_error;
  out["loose_particles"] = found.loose;
  if (found.sudden_break) {
    out["sudden_break"] = {{"time_s", found.sudden_break->time_s},
                           {"temperature_c", found.temperature_at_break_c},
                           {"strain", found.sudden_break->strain},
                           {"stress_pa", found.sudden_break->stress_pa}};
  }
  if (found.first_drop) {
    out["sudden_drops"] = {{"number", found.drops},
                           {"energy_j", found.drop_energy_j},
                           {"first_time_s", found.first_drop->time_s},
                           {"first_strain", found.first_drop->strain},
                           {"first_stress_pa", found.first_drop->stress_pa}};
  }
  if (!found.unstable) return;
  out["unstable"] = {{"time_s", found.unstable->time_s},
                     {"strain", found.unstable->strain},
                     {"stress_pa", found.unstable->stress_pa},
                     {"increments", found.by_opening}};
}

std::string increment_words(const SteppedResponse& found) {
  const experiments::Increments& i = *found.increments;
  return fmt::format(
      "\n{}; {} increments without inertia, {} linear systems in {:.1f} s\n"
      "error: {}\n",
      load_kind_words(found), i.increments, i.systems, found.seconds,
      found.cracks ? fmt::format("largest sum of the estimated errors of the increments, relative to the largest {}",
                                 found.kind == experiments::Creep::kind ? "strain" : "stress")
                   : "difference from the exact solution in time; an estimate if that solution is not known");
}

}  // namespace

template <>
void ResultOf<SteppedResponse>::summarise(const SteppedResponse& found, const Scene& scene, const RunResult& run,
                                          nlohmann::ordered_json& summary) {
  using Json = nlohmann::ordered_json;
  if (!found.kind.empty()) {
    const LoadWords& words = load_words(found.kind);
    Json out = {{"kind", found.kind},
                {"sides", found.confined ? "held" : "free"},
                {"modulus", modulus_name(found)},
                {"method", found.increments ? "quasi_static" : "explicit"}};
    if (!found.increments)
      out.update({{"density_scaling", found.density_scaling}, {"dt_s", found.dt_s}, {"steps", found.steps}});
    out["error"] = found.error();
    if (!found.increments) out["kinetic_share"] = found.kinetic_share;
    out["solve_s"] = found.seconds;
    add_load(load_test_of(scene), out);
    if (words.ratio) out["ramp_s"] = found.ramp_s;
    add_extremes(found.kind, found.points, out);
    if (found.cooling) add_cooling(*found.cooling, out);
    if (measures_strength(found) && !has_standard_results(found)) add_strength(found, out);
    if (has_standard_results(found)) add_standard_results(found, passed_its_peak(found), out);
    if (found.cracks && found.cracks->sums) {
      const auto error = energy_error_of(found);
      out["energy_error"] = error ? Json(*error) : Json();
    }
    if (found.increments) add_increments(*found.increments, out);
    if (found.rupture) out["rupture"] = rupture_json(*found.rupture);
    if (found.platen_mass_kg > 0) out["platen_mass_kg"] = found.platen_mass_kg;
    for (const SteppedPoint& p : found.points) {
      Json point = point_json(words, p);
      if (has_standard_results(found)) {
        point["displacement_m"] = -p.strain * gauge_length(scene.specimen.box);
        point["load_n"] = -p.stress_pa * section_area(scene.specimen.box);
      }
      point["error"] = p.error;
      point["top_pa"] = p.top_pa;
      point["bottom_pa"] = p.bottom_pa;
      point["kinetic_j"] = p.kinetic_j;
      if (std::isfinite(p.temperature_c)) point["temperature_c"] = p.temperature_c;
      if (!found.confined) point["poisson_ratio"] = std::isfinite(p.poisson_ratio) ? Json(p.poisson_ratio) : Json();
      if (found.cracks) point["broken_points"] = p.broken_points;
      if (found.cracks && found.cracks->sums) {
        point["cracked_points"] = p.cracks.cracked;
        Json& areas = point["cracked_area_m2"] = Json::object();
        for (std::size_t i = 0; i < pair_types; ++i) {
          if (found.cracks->by_pair[i].breakable > 0)
            areas[to_string(static_cast<PairType>(i))] = p.cracks.cracked_area_m2[i];
        }
        add_energies(p.energies, found.damping_kind != Damping::none, std::isfinite(p.temperature_c), point);
      }
      out["points"].push_back(std::move(point));
    }
    summary["results"].push_back(std::move(out));
  }
  if (found.cracks) summary["cracks"] = cracks_json(*found.cracks);
  Json& solver = summary["solver"];
  if (scene.solver.method == SolverMethod::quasi_static) return add_increment_settings(found, run, solver);
  add_settings(found, scene, run, found.steps, found.dt_s > 0 ? std::optional(found.dt_s) : std::nullopt, solver);
  solver["damping"] = {{"kind", to_string(found.damping_kind)}, {"value", found.damping}};
}

template <>
double ResultOf<SteppedResponse>::seconds(const SteppedResponse& found) {
  return found.seconds_planning + found.seconds;
}

template <>
std::string ResultOf<SteppedResponse>::table(const SteppedResponse& found) {
  const LoadWords& words = load_words(found.kind);
  std::string out = found.cooling              ? cooling_words(*found.cooling)
                    : measures_strength(found) ? strength_words(found)
                                               : "";
  if (found.rupture && measures_strength(found)) out += rupture_words(*found.rupture) + "\n";
  if (found.cracks) out += cracks_words(*found.cracks) + "\n";
  if (found.cracks && found.cracks->sums && !found.points.empty()) out += energy_words(found);
  const char* ratio = words.shown_stepped;
  const bool cools = found.cooling.has_value();
  out += shown_head(ratio) + (cools ? fmt::format(" {:>9}", "T (degC)") : "") + fmt::format(" {:>9}", "error") +
         (found.cracks ? fmt::format(" {:>9}", "broken") : "");
  for (const SteppedPoint& p : found.points) {
    out += shown_line(words, ratio, p) + (cools ? fmt::format(" {:>9.2f}", p.temperature_c) : "") +
           fmt::format(" {:>9.1e}", p.error) + (found.cracks ? fmt::format(" {:>9}", p.broken_points) : "");
  }
  if (found.increments) return out + increment_words(found);
  return out + fmt::format(
                   "\n{}; {} steps of {:.3g} s with density scaling {:g} in {:.1f} s\n"
                   "error: difference from the solution without time steps, or an estimate if there is no such "
                   "solution; kinetic "
                   "energy: at most {:.1e} of the work\n",
                   load_kind_words(found), found.steps, found.dt_s, found.density_scaling, found.seconds,
                   found.kinetic_share);
}

}  // namespace macadam
