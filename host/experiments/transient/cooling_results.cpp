// SPDX-License-Identifier: GPL-3.0-or-later
// cooling_results.cpp  Computes fracture temperature and fracture stress, and writes them as text and as JSON.
#include "host/experiments/transient/cooling_results.hpp"

#include <fmt/format.h>

namespace macadam {

using experiments::CoolingResults;

namespace {

/// A specimen in one piece counts as broken if its stress has fallen to this part of the largest one.
constexpr double fallen_to = 0.5;

bool is_broken(const experiments::SteppedResponse& found, double largest_pa) {
  if (found.rupture || (found.increments && found.increments->sudden_break)) return true;
  return !found.points.empty() && found.points.back().stress_pa < fallen_to * largest_pa;
}

}  // namespace

CoolingResults cooling_results(const experiments::SteppedResponse& found, const experiments::Peak& largest,
                               const TemperatureHistory& temperature) {
  return {largest.stress_pa, temperature.at(largest.time_s), is_broken(found, largest.stress_pa)};
}

std::string cooling_words(const CoolingResults& results) {
  if (!results.broke)
    return fmt::format("largest tensile stress {:.5g} MPa at {:.4g} degrees C; the specimen did not break\n",
                       results.largest_stress_pa / 1e6, results.temperature_c);
  return fmt::format("fracture temperature {:.4g} degrees C, fracture stress {:.5g} MPa (EN 12697-46)\n",
                     results.temperature_c, results.largest_stress_pa / 1e6);
}

void add_cooling(const CoolingResults& results, nlohmann::ordered_json& out) {
  using Json = nlohmann::ordered_json;
  out["broke"] = results.broke;
  out["fracture_temperature_c"] = results.broke ? Json(results.temperature_c) : Json();
  out["fracture_stress_pa"] = results.broke ? Json(results.largest_stress_pa) : Json();
  out["largest_stress_pa"] = results.largest_stress_pa;
  out["temperature_at_largest_stress_c"] = results.temperature_c;
}

}  // namespace macadam
