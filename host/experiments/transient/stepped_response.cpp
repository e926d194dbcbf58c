// SPDX-License-Identifier: GPL-3.0-or-later
// stepped_response.cpp  Reports a stepped test of a load in summary.json and in the text that the command prints.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

namespace {

/// Returns whether the peak counts as the strength of the specimen: the specimen broke, or contact points broke or
/// cracked and the stress then fell by more than 1 % below the peak.
bool passed_peak(const SteppedResponse& found) {
  if (found.rupture) return true;
  constexpr double fallen = 0.99;
  const bool damaged = found.cracks->points() > 0 || (found.cracks->sums && found.cracks->sums->cracked > 0);
  return damaged &&
         std::abs(found.points.back().stress_pa) < fallen * std::abs(found.peak->stress_pa);
}

bool measures_strength(const SteppedResponse& found) { return found.peak && !found.points.empty(); }

/// Returns the line about the strength. This line is printed first, because the strength is the main result of such a
/// test.
std::string strength_words(const SteppedResponse& found) {
  return fmt::format("{} {:.6g} MPa at a strain of {:.6g} (t = {:.5g} s){}\n",
                     passed_peak(found) ? "strength" : "largest stress", found.peak->stress_pa / 1e6,
                     found.peak->strain, found.peak->time_s,
                     passed_peak(found) ? "" : "; the strength was not reached");
}

void add_strength(const SteppedResponse& found, nlohmann::ordered_json& out) {
  const bool passed = passed_peak(found);
  out["strength_pa"] = passed ? nlohmann::ordered_json(found.peak->stress_pa) : nlohmann::ordered_json();
  out["strain_at_peak"] = passed ? nlohmann::ordered_json(found.peak->strain) : nlohmann::ordered_json();
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
                {"modulus", found.confined ? "confined" : "uniaxial"},
                {"method", "explicit"},
                {"density_scaling", found.density_scaling},
                {"dt_s", found.dt_s},
                {"steps", found.steps},
                {"error", found.error()},
                {"kinetic_share", found.kinetic_share},
                {"solve_s", found.seconds}};
    add_load(load_test_of(scene), out);
    if (words.ratio) out["ramp_s"] = found.ramp_s;
    add_extremes(found.kind, found.points, out);
    if (measures_strength(found)) add_strength(found, out);
    if (found.rupture) out["rupture"] = rupture_json(*found.rupture, *found.cracks);
    if (found.platen_mass_kg > 0) out["platen_mass_kg"] = found.platen_mass_kg;
    for (const SteppedPoint& p : found.points) {
      Json point = point_json(words, p);
      point["error"] = p.error;
      point["top_pa"] = p.top_pa;
      point["bottom_pa"] = p.bottom_pa;
      point["kinetic_j"] = p.kinetic_j;
      if (found.cracks) point["broken_points"] = p.broken_points;
      if (found.cracks && found.cracks->sums) {
        point["cracked_points"] = p.cracks.cracked;
        point["crack_energy_j"] = p.cracks.crack_energy_j;
        point["friction_energy_j"] = p.cracks.friction_energy_j;
      }
      out["points"].push_back(std::move(point));
    }
    summary["results"].push_back(std::move(out));
  }
  if (found.cracks) summary["cracks"] = cracks_json(*found.cracks);
  Json& solver = summary["solver"];
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
  std::string out = measures_strength(found) ? strength_words(found) : "";
  if (found.rupture && measures_strength(found)) out += rupture_words(*found.rupture, *found.cracks) + "\n";
  if (found.cracks) out += cracks_words(*found.cracks) + "\n";
  const char* ratio = words.shown_stepped;
  out += shown_head(ratio) + fmt::format(" {:>9}", "error") + (found.cracks ? fmt::format(" {:>9}", "broken") : "");
  for (const SteppedPoint& p : found.points) {
    out += shown_line(words, ratio, p) + fmt::format(" {:>9.1e}", p.error) +
           (found.cracks ? fmt::format(" {:>9}", p.broken_points) : "");
  }
  return out + fmt::format(
                   "\n{}; {} steps of {:.3g} s with density scaling {:g} in {:.1f} s\n"
                   "error: difference from the solution without time steps, or an estimate if there is no such "
                   "solution; kinetic "
                   "energy: at most {:.1e} of the work\n",
                   modulus_words(found.confined), found.steps, found.dt_s, found.density_scaling, found.seconds,
                   found.kinetic_share);
}

}  // namespace macadam
