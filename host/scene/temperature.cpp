// SPDX-License-Identifier: GPL-3.0-or-later
// temperature.cpp  Shifts the laws of a scene to its temperature, or to the temperatures of its loading.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/scene/sections.hpp"
#include "host/scene/shift_keys.hpp"

namespace macadam {
namespace {

bool shifts(const laws::Shift& shift) { return !std::holds_alternative<laws::NoShift>(shift); }

/// Returns log10 of the shift factor with which the scene's laws are already shifted; 0 if the laws are at their
/// reference temperatures.
double present(const Scene& scene, const laws::Shift& shift) {
  return scene.materials.temperature ? laws::log10_shift(shift, *scene.materials.temperature) : 0;
}

}  // namespace

LawTable laws_at(const Scene& scene, double temperature) { return laws_at(scene, temperature, scene.laws); }

LawTable laws_at(const Scene& scene, double temperature, LawTable laws) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const laws::Shift& shift = scene.shifts[pair];
    if (!laws[pair] || !shifts(shift)) continue;
    laws[pair] =
        laws::shifted(*laws[pair], std::pow(10.0, laws::log10_shift(shift, temperature) - present(scene, shift)));
  }
  return laws;
}

LawTable reference_laws(const Scene& scene) {
  LawTable out = scene.laws;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (out[pair] && shifts(scene.shifts[pair]))
      out[pair] = laws::shifted(*out[pair], std::pow(10.0, -present(scene, scene.shifts[pair])));
  }
  return out;
}

std::optional<double> common_log10_shift(const Scene& scene, double temperature) {
  std::optional<double> out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!scene.laws[pair] || !laws::flows(*scene.laws[pair])) continue;
    const double own = laws::log10_shift(scene.shifts[pair], temperature);
    if (out && *out != own) return {};
    out = own;
  }
  return out;
}

namespace scene {

void apply_temperature(Scene& scene, const Section& root, const TemperatureTables& tables) {
  const auto check_values = [&](const Section& section, const std::string& key, double temperature) {
    LawTable at = laws_at(scene, temperature);
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      if (!at[pair] || laws::usable(*at[pair])) continue;
      section.refuse(key,
                     fmt::format("{} degrees C, where the shift of {} has no value", temperature,
                                 to_string(static_cast<PairType>(pair))),
                     range_of(scene.shifts[pair]));
    }
    return at;
  };
  const auto check = [&](const std::string& in, const std::string& key, double temperature) {
    const Section section = root.find(in)->section();
    if (!tables.used && std::none_of(scene.shifts.begin(), scene.shifts.end(), shifts)) {
      section.refuse(
          key, fmt::format("{} degrees C, which changes no law of the scene", temperature),
          std::string("shift = \"wlf\", \"arrhenius\" or \"table\" in ") +
              (has_laws_of_phases(scene.network.rule) ? "[materials.mastic]" : "at least one section [[contacts]]"));
    }
    return check_values(section, key, temperature);
  };
  const std::vector<double> several = temperatures_of(scene.experiment);
  if (!several.empty()) {
    const Section loading = root.find("loading")->section();
    if (scene.materials.temperature) {
      loading.refuse("temperatures", "this key with temperature in [materials]", "only one of the two");
    }
    for (const double temperature : several) check("loading", "temperatures", temperature);
  }
  if (const TemperatureHistory history = temperature_history_of(scene.experiment); !history.empty()) {
    const Section loading = root.find("loading")->section();
    if (scene.materials.temperature)
      loading.refuse("temperature", "this key with temperature in [materials]", "only one of the two");
    if (!scene.materials.expansion.any() && std::none_of(scene.shifts.begin(), scene.shifts.end(), shifts)) {
      loading.refuse("temperature", "a temperature that changes nothing in the scene",
                     "expansion in [materials.mastic] or [materials.aggregate], or a law with a shift");
    }
    const auto* cooling = std::get_if<experiments::Cooling>(&scene.experiment);
    for (const double temperature : history.temperatures)
      check_values(loading, !cooling ? "temperature" : temperature == cooling->to ? "to" : "from", temperature);
  }
  if (const std::optional<double> temperature = scene.materials.temperature) {
    // laws_at() assumes that the laws are at the scene's temperature, but they are still at their reference
    // temperatures. So the scene's temperature is removed for the call.
    scene.materials.temperature.reset();
    scene.laws = check("materials", "temperature", *temperature);
    scene.materials.temperature = temperature;
  }
}

}  // namespace scene
}  // namespace macadam
