// SPDX-License-Identifier: GPL-3.0-or-later
// stepped_response.cpp  A stepped test of a load in summary.json and for people.
#include <fmt/format.h>

#include <algorithm>

#include "host/experiments/loaded/load_test.hpp"
#include "host/experiments/stepped/settings.hpp"

namespace macadam {

using experiments::SteppedPoint;
using experiments::SteppedResponse;

double experiments::SteppedResponse::error() const {
  double out = 0;
  for (const SteppedPoint& p : points) out = std::max(out, p.error);
  return out;
}

template <>
void ResultOf<SteppedResponse>::summarise(const SteppedResponse& found, const Scene& scene, const RunResult& run,
                                          nlohmann::ordered_json& summary) {
  using Json = nlohmann::ordered_json;
  if (!found.kind.empty()) {
    const LoadWords& words = words_of(found.kind);
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
    out["ramp_s"] = found.ramp_s;
    if (found.platen_mass_kg > 0) out["platen_mass_kg"] = found.platen_mass_kg;
    for (const SteppedPoint& p : found.points) {
      Json point = point_json(words, p);
      point["error"] = p.error;
      point["top_pa"] = p.top_pa;
      point["bottom_pa"] = p.bottom_pa;
      point["kinetic_j"] = p.kinetic_j;
      out["points"].push_back(std::move(point));
    }
    summary["results"].push_back(std::move(out));
  }
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
  const LoadWords& words = words_of(found.kind);
  const char* ratio = words.shown_stepped;
  std::string out = shown_head(ratio) + fmt::format(" {:>9}", "error");
  for (const SteppedPoint& p : found.points) out += shown_line(words, ratio, p) + fmt::format(" {:>9.1e}", p.error);
  return out +
         fmt::format(
             "\n{}; {} steps of {:.3g} s with density scaling {:g} in {:.1f} s\n"
             "error: from the answer without steps, or an estimate where there is none; kinetic energy: {:.1e} of the "
             "work\n",
             modulus_words(found.confined), found.steps, found.dt_s, found.density_scaling, found.seconds,
             found.kinetic_share);
}

}  // namespace macadam
